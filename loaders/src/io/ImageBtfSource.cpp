#include "ImageBtfSource.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "AngleName.h"
#include "ParallelTry.h"
#include "weft/core/Contract.h"
#include "weft/core/Direction.h"
#include "weft/io/ImageFile.h"

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

struct NamedImages {
  FileOfPair fileOfPair;
  Encoding encoding = Encoding::Gamma22;
};

Result<NamedImages> findImages(const FileCollection& files, const std::string& where) {
  NamedImages images;
  const std::vector<std::string>& names = files.names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto encoding = encodingOf(names[i]);
    const auto angles = anglesFromName(std::string_view(names[i]).substr(names[i].rfind('/') + 1));
    if (!encoding || !angles) continue;
    if (!images.fileOfPair.empty() && *encoding != images.encoding)
      return fail("JPEGs and PNGs are mixed, which store different encodings", where + ": " + names[i]);
    images.encoding = *encoding;
    const auto [known, isNew] = images.fileOfPair.emplace(*angles, static_cast<int>(i));
    if (!isNew)
      return fail(
          fmt::format("the same light and view as '{}'", names[static_cast<std::size_t>(known->second)]),
          where + ": " + names[i], "remove one of the two");
  }
  if (images.fileOfPair.empty())
    return fail("there are no images named by their angles", where,
                "names like 'tl015 pl000 tv030 pv180.jpg' are expected");
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

Result<std::unique_ptr<ImageBtfSource>> ImageBtfSource::create(std::unique_ptr<FileCollection> files,
                                                               std::string where, std::string name) {
  WEFT_TRY(const NamedImages images, findImages(*files, where));
  std::set<Angles> views;
  std::set<Angles> lights;
  for (const auto& [angles, file] : images.fileOfPair) views.insert(angles.view), lights.insert(angles.light);

  std::unique_ptr<ImageBtfSource> source(new ImageBtfSource);
  WEFT_TRY(source->fileOfPair_, completeTable(images.fileOfPair, views, lights, where));
  source->files_ = std::move(files);
  source->where_ = std::move(where);

  const int first = source->fileOfPair_.front();
  WEFT_TRY(const std::vector<std::uint8_t> bytes, source->files_->read(first));
  WEFT_TRY(const ImageSize size, imageSize(bytes, source->whereOf(first)));

  BtfDescription& description = source->description_;
  description.width = size.width;
  description.height = size.height;
  description.views = directions(views);
  description.lights = directions(lights);
  description.encoding = images.encoding;
  description.cosineInData = true;  // photographs of an irradiated surface
  description.name = std::move(name);
  for (std::size_t i = 0; i < source->linear_.size(); ++i)
    source->linear_[i] = decode(images.encoding, static_cast<float>(i) / 255.0f);
  return source;
}

std::string ImageBtfSource::whereOf(int file) const {
  return where_ + ": " + files_->names()[static_cast<std::size_t>(file)];
}

Result<Image> ImageBtfSource::readPair(int view, int light) const {
  const std::size_t lights = description_.lights.size();
  const int file = fileOfPair_[static_cast<std::size_t>(view) * lights + static_cast<std::size_t>(light)];
  WEFT_TRY(const std::vector<std::uint8_t> bytes, files_->read(file));
  WEFT_TRY(const ImageSize size, imageSize(bytes, whereOf(file)));
  if (size.width != description_.width || size.height != description_.height)
    return fail(fmt::format("the image has {} x {} pixels, the others have {} x {}", size.width, size.height,
                            description_.width, description_.height),
                whereOf(file));
  return decodeImage(bytes, whereOf(file));
}

Result<void> ImageBtfSource::readView(int view, std::span<float> out) const {
  const std::size_t lights = description_.lights.size();
  const std::size_t texels = description_.texels();
  WEFT_EXPECT(view >= 0 && view < static_cast<int>(description_.views.size()), "the view exists");
  WEFT_EXPECT(out.size() == lights * texels * 3, "out holds [light][row][column][rgb]");
  return parallelTry(static_cast<int>(lights), [&](int light) -> Result<void> {
    WEFT_TRY(const Image image, readPair(view, light));
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    float* to = out.data() + static_cast<std::size_t>(light) * texels * 3;
    for (std::size_t texel = 0; texel < texels; ++texel)
      for (std::size_t c = 0; c < 3; ++c)
        *to++ = linear_[image.bytes[texel * channels + (channels < 3 ? 0 : c)]];
    return {};
  });
}

Result<void> ImageBtfSource::readRows(int firstRow, int rowCount, std::span<float> out) const {
  const std::size_t views = description_.views.size();
  const std::size_t lights = description_.lights.size();
  WEFT_EXPECT(firstRow >= 0 && rowCount > 0 && firstRow + rowCount <= description_.height, "the rows exist");
  const std::size_t texels =
      static_cast<std::size_t>(rowCount) * static_cast<std::size_t>(description_.width);
  WEFT_EXPECT(out.size() == texels * views * lights * 3, "out holds [row][column][view][light][rgb]");

  // A view at a time keeps the writes of a thread together. What waits to be transposed waits as bytes.
  return parallelTry(static_cast<int>(views), [&](int view) -> Result<void> {
    std::vector<std::uint8_t> stored(lights * texels * 3);  // [light][row][column][rgb]
    for (std::size_t light = 0; light < lights; ++light) {
      WEFT_TRY(const Image image, readPair(view, static_cast<int>(light)));
      const std::size_t channels = static_cast<std::size_t>(image.channels);
      const std::uint8_t* from = image.pixel(0, firstRow);
      for (std::size_t texel = 0; texel < texels; ++texel)
        for (std::size_t c = 0; c < 3; ++c)
          stored[(light * texels + texel) * 3 + c] = from[texel * channels + (channels < 3 ? 0 : c)];
    }
    for (std::size_t texel = 0; texel < texels; ++texel) {
      float* to = out.data() + (texel * views + static_cast<std::size_t>(view)) * lights * 3;
      for (std::size_t light = 0; light < lights; ++light)
        for (std::size_t c = 0; c < 3; ++c) *to++ = linear_[stored[(light * texels + texel) * 3 + c]];
    }
    return {};
  });
}

}  // namespace weft
