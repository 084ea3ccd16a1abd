#include "AngleImages.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "AngleName.h"
#include "FilePath.h"
#include "ImageBtfSource.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

using FileOfPair = std::map<AnglePair, int>;

// What measurements store in which format decides how their values are encoded.
Encoding encodingOf(const std::string& name) {
  return extensionOf(name) == ".png" ? Encoding::Srgb : Encoding::Gamma22;
}

struct NamedImages {
  FileOfPair fileOfPair;
  Encoding encoding = Encoding::Gamma22;
  std::vector<std::string> withoutAngles;
  std::vector<std::string> ofOtherFormat;
  std::vector<std::string> belowHorizon;
};

Result<void> addImage(NamedImages& images, const AnglePair& angles, const FileCollection& files, int index,
                      const std::string& where) {
  const std::string& name = files.names()[static_cast<std::size_t>(index)];
  if (!images.fileOfPair.empty() && encodingOf(name) != images.encoding)
    return fail("JPEGs and PNGs are mixed, which store different encodings", where + ": " + name);
  images.encoding = encodingOf(name);
  const auto [known, isNew] = images.fileOfPair.emplace(angles, index);
  if (!isNew)
    return fail(fmt::format("the same light and view as '{}'",
                            files.names()[static_cast<std::size_t>(known->second)]),
                where + ": " + name, "remove one of the two");
  return {};
}

Result<NamedImages> findImages(const FileCollection& files, const std::string& where) {
  NamedImages images;
  for (std::size_t i = 0; i < files.names().size(); ++i) {
    const std::string& name = files.names()[i];
    if (!isAnyImage(name)) continue;
    const auto angles = anglesFromName(fileNameOf(name));
    if (!angles)
      images.withoutAngles.push_back(name);
    else if (!isReadableImage(name))
      images.ofOtherFormat.push_back(name);
    else if (angles->light.theta > 90.0 || angles->view.theta > 90.0)
      images.belowHorizon.push_back(name);
    else
      WEFT_TRY_VOID(addImage(images, *angles, files, static_cast<int>(i), where));
  }
  return images;
}

tl::unexpected<Error> failNoImages(const NamedImages& images, const std::string& where) {
  if (!images.ofOtherFormat.empty())
    return fail("only JPEGs and PNGs are read as measurements, not " + firstOf(images.ofOtherFormat), where,
                "convert them");
  std::string what = "there are no images named by their angles";
  if (!images.belowHorizon.empty())
    what += ", but below the horizon: " + firstOf(images.belowHorizon);
  else if (!images.withoutAngles.empty())
    what += ", but " + firstOf(images.withoutAngles);
  return fail(what, where,
              "names like 'tl015 pl000 tv030 pv180.jpg' are expected, or one .lp beside its images");
}

// What is not part of the measurement although it is an image.
std::vector<std::string> warningsOf(const NamedImages& images) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::vector<std::string>& names, const std::string& reason) {
    if (!names.empty())
      warnings.push_back(fmt::format("{} of the images {} not read, {}: {}", names.size(),
                                     names.size() == 1 ? "is" : "are", reason, firstOf(names)));
  };
  add(images.withoutAngles, "whose names do not hold the angles of light and view");
  add(images.ofOtherFormat, "which are no JPEGs or PNGs");
  add(images.belowHorizon, "lit or seen from below the horizon");
  return warnings;
}

std::string nameOf(const AnglePair& pair) {
  return fmt::format("light (theta {}, phi {}) and view (theta {}, phi {})", pair.light.theta, pair.light.phi,
                     pair.view.theta, pair.view.phi);
}

// Looks no further, because the product of a hostile set's directions is without bound.
std::vector<std::string> firstMissing(const FileOfPair& fileOfPair, const std::set<Angles>& views,
                                      const std::set<Angles>& lights) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> missing;
  for (const Angles& view : views)
    for (const Angles& light : lights) {
      if (fileOfPair.contains({light, view})) continue;
      missing.push_back(nameOf({light, view}));
      if (missing.size() == kNamed) return missing;
    }
  return missing;
}

tl::unexpected<Error> failIncomplete(const NamedImages& images, const std::set<Angles>& views,
                                     const std::set<Angles>& lights, const std::string& where) {
  const std::size_t needed = views.size() * lights.size();
  const std::size_t there = images.fileOfPair.size();
  const std::vector<std::string> missing = firstMissing(images.fileOfPair, views, lights);
  std::string what = fmt::format("no image for {}", fmt::join(missing, ", for "));
  if (needed - there > missing.size())
    what += fmt::format(" and for {} more pairs", needed - there - missing.size());
  std::string hint = fmt::format("{} views x {} lights need {} images, {} are there", views.size(),
                                 lights.size(), needed, there);
  if (!images.withoutAngles.empty())
    hint += "; no angles are found in the names of " + firstOf(images.withoutAngles);
  return fail(what, where, hint);
}

// [view][light] -> file, of a complete set.
std::vector<int> tableOf(const FileOfPair& fileOfPair, const std::set<Angles>& views,
                         const std::set<Angles>& lights) {
  std::vector<int> table;
  for (const Angles& view : views)
    for (const Angles& light : lights) table.push_back(fileOfPair.at({light, view}));
  return table;
}

std::vector<glm::vec3> directions(const std::set<Angles>& angles) {
  std::vector<glm::vec3> result;
  for (const Angles& a : angles) result.push_back(directionFromDegrees(a.theta, a.phi));
  return result;
}

}  // namespace

bool hasAngleImages(const FileCollection& files) {
  return std::ranges::any_of(files.names(), [](const std::string& name) {
    return isReadableImage(name) && anglesFromName(fileNameOf(name)).has_value();
  });
}

Result<std::unique_ptr<BtfSource>> openAngleImages(std::unique_ptr<FileCollection> files, std::string where,
                                                   std::string name) {
  WEFT_TRY(const NamedImages images, findImages(*files, where));
  if (images.fileOfPair.empty()) return failNoImages(images, where);
  std::set<Angles> views;
  std::set<Angles> lights;
  for (const auto& [angles, file] : images.fileOfPair) views.insert(angles.view), lights.insert(angles.light);
  if (images.fileOfPair.size() < views.size() * lights.size())
    return failIncomplete(images, views, lights, where);
  BtfDescription description;
  description.views = directions(views);
  description.lights = directions(lights);
  description.encoding = images.encoding;
  description.name = std::move(name);
  description.warnings = warningsOf(images);
  return ImageBtfSource::create(std::move(description), std::move(files),
                                tableOf(images.fileOfPair, views, lights), std::move(where));
}

}  // namespace weft
