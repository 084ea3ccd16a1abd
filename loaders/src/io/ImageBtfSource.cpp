#include "ImageBtfSource.h"

#include <fmt/format.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
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

// Images wait as a batch for being transposed, so that what is written to a texel is a long run.
constexpr std::size_t kBatchBytes = std::size_t{64} << 20;

// As many rows as `out` holds.
void copyRgb(const Image& image, int firstRow, std::span<std::uint8_t> out) {
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::uint8_t* from = image.pixel(0, firstRow);
  if (channels == 3) {
    std::copy_n(from, out.size(), out.begin());
    return;
  }
  for (std::size_t i = 0; i < out.size(); i += 3, from += channels)
    for (std::size_t c = 0; c < 3; ++c) out[i + c] = from[channels < 3 ? 0 : c];
}

// `images[pair][texel][rgb]` to `out[texel * stride + pair * 3 + rgb]`, by tiles that stay in the first
// cache: a line of every image would not, as they lie at distances that are multiples of its size.
void transpose(std::span<const std::uint8_t> images, std::size_t pairs, std::size_t texels, std::uint8_t* out,
               std::size_t stride) {
  constexpr std::size_t kTilePairs = 128;
  constexpr std::size_t kTileTexels = 64;
  tbb::parallel_for(std::size_t{0}, (texels + kTileTexels - 1) / kTileTexels, [&](std::size_t tile) {
    const std::size_t firstTexel = tile * kTileTexels;
    const std::size_t tileTexels = std::min(kTileTexels, texels - firstTexel);
    for (std::size_t firstPair = 0; firstPair < pairs; firstPair += kTilePairs) {
      const std::size_t tilePairs = std::min(kTilePairs, pairs - firstPair);
      for (std::size_t pair = firstPair; pair < firstPair + tilePairs; ++pair) {
        const std::uint8_t* from = &images[(pair * texels + firstTexel) * 3];
        std::uint8_t* to = out + firstTexel * stride + pair * 3;
        for (std::size_t i = 0; i < tileTexels; ++i) std::memcpy(to + i * stride, from + i * 3, 3);
      }
    }
  });
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
  description.storedAsBytes = true;
  description.cosineInData = true;  // photographs of an irradiated surface
  description.name = std::move(name);
  return source;
}

std::string ImageBtfSource::whereOf(int file) const {
  return where_ + ": " + files_->names()[static_cast<std::size_t>(file)];
}

Result<Image> ImageBtfSource::readPair(std::size_t pair) const {
  const int file = fileOfPair_[pair];
  WEFT_TRY(const std::vector<std::uint8_t> bytes, files_->read(file));
  WEFT_TRY(const ImageSize size, imageSize(bytes, whereOf(file)));
  if (size.width != description_.width || size.height != description_.height)
    return fail(fmt::format("the image has {} x {} pixels, the others have {} x {}", size.width, size.height,
                            description_.width, description_.height),
                whereOf(file));
  return decodeImage(bytes, whereOf(file));
}

Result<void> ImageBtfSource::readRows(int firstRow, int rowCount, SampleRows& out) const {
  WEFT_EXPECT(firstRow >= 0 && rowCount > 0 && firstRow + rowCount <= description_.height, "the rows exist");
  WEFT_TRY_VOID(out.allocate(description_, rowCount));
  const std::size_t texels =
      static_cast<std::size_t>(rowCount) * static_cast<std::size_t>(description_.width);
  const std::size_t imageBytes = texels * 3;
  const std::size_t pairsAtOnce = std::clamp<std::size_t>(kBatchBytes / imageBytes, 1, out.pairs());
  std::vector<std::uint8_t> batch(pairsAtOnce * imageBytes);  // [pair][row][column][rgb]
  for (std::size_t first = 0; first < out.pairs(); first += pairsAtOnce) {
    const std::size_t count = std::min(pairsAtOnce, out.pairs() - first);
    WEFT_TRY_VOID(parallelTry(static_cast<int>(count), [&](int index) -> Result<void> {
      const std::size_t i = static_cast<std::size_t>(index);
      WEFT_TRY(const Image image, readPair(first + i));
      copyRgb(image, firstRow, std::span(batch).subspan(i * imageBytes, imageBytes));
      return {};
    }));
    transpose(batch, count, texels, out.bytes().data() + first * 3, out.pairs() * 3);
  }
  return {};
}

}  // namespace weft
