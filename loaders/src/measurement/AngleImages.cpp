#include "AngleImages.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "AngleName.h"
#include "ImageBtfSource.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

using FileOfPair = std::map<AnglePair, int>;

// By the extension; what measurements store in which format decides how their values are encoded.
std::optional<Encoding> encodingOf(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (name.ends_with(".jpg") || name.ends_with(".jpeg")) return Encoding::Gamma22;
  if (name.ends_with(".png")) return Encoding::Srgb;
  return std::nullopt;
}

struct NamedImage {
  AnglePair angles;
  Encoding encoding;
};

std::optional<NamedImage> imageNamed(std::string_view name) {
  const auto encoding = encodingOf(std::string(name));
  const auto angles = anglesFromName(name.substr(name.rfind('/') + 1));
  if (!encoding || !angles) return std::nullopt;
  return NamedImage{*angles, *encoding};
}

struct NamedImages {
  FileOfPair fileOfPair;
  Encoding encoding = Encoding::Gamma22;
};

Result<NamedImages> findImages(const FileCollection& files, const std::string& where) {
  NamedImages images;
  const std::vector<std::string>& names = files.names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto image = imageNamed(names[i]);
    if (!image) continue;
    if (!images.fileOfPair.empty() && image->encoding != images.encoding)
      return fail("JPEGs and PNGs are mixed, which store different encodings", where + ": " + names[i]);
    images.encoding = image->encoding;
    const auto [known, isNew] = images.fileOfPair.emplace(image->angles, static_cast<int>(i));
    if (!isNew)
      return fail(
          fmt::format("the same light and view as '{}'", names[static_cast<std::size_t>(known->second)]),
          where + ": " + names[i], "remove one of the two");
  }
  if (images.fileOfPair.empty())
    return fail("there are no images named by their angles", where,
                "names like 'tl015 pl000 tv030 pv180.jpg' are expected, or one .lp beside its images");
  return images;
}

// [view][light] -> file; fails on the first pair without one.
Result<std::vector<int>> completeTable(const FileOfPair& fileOfPair, const std::set<Angles>& views,
                                       const std::set<Angles>& lights, const std::string& where) {
  std::vector<int> table;
  for (const Angles& view : views)
    for (const Angles& light : lights) {
      const auto found = fileOfPair.find({light, view});
      if (found == fileOfPair.end())
        return fail(fmt::format("no image for light (theta {}, phi {}) and view (theta {}, phi {})",
                                light.theta, light.phi, view.theta, view.phi),
                    where,
                    fmt::format("{} views x {} lights need {} images, {} are there", views.size(),
                                lights.size(), views.size() * lights.size(), fileOfPair.size()));
      table.push_back(found->second);
    }
  return table;
}

std::vector<glm::vec3> directions(const std::set<Angles>& angles) {
  std::vector<glm::vec3> result;
  for (const Angles& a : angles) result.push_back(directionFromDegrees(a.theta, a.phi));
  return result;
}

}  // namespace

bool hasAngleImages(const FileCollection& files) {
  return std::ranges::any_of(files.names(),
                             [](const std::string& name) { return imageNamed(name).has_value(); });
}

Result<std::unique_ptr<BtfSource>> openAngleImages(std::unique_ptr<FileCollection> files, std::string where,
                                                   std::string name) {
  WEFT_TRY(const NamedImages images, findImages(*files, where));
  std::set<Angles> views;
  std::set<Angles> lights;
  for (const auto& [angles, file] : images.fileOfPair) views.insert(angles.view), lights.insert(angles.light);
  WEFT_TRY(std::vector<int> fileOfPair, completeTable(images.fileOfPair, views, lights, where));
  BtfDescription description;
  description.views = directions(views);
  description.lights = directions(lights);
  description.encoding = images.encoding;
  description.name = std::move(name);
  return ImageBtfSource::create(std::move(description), std::move(files), std::move(fileOfPair),
                                std::move(where));
}

}  // namespace weft
