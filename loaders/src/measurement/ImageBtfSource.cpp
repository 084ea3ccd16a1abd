#include "ImageBtfSource.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "weft/core/Contract.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ParallelTry.h"

namespace weft {
namespace {

// Images wait as a batch for being transposed, so that what is written to a texel is a long run.
constexpr std::size_t kBatchBytes = std::size_t{128} << 20;

// Bytes from an image to the next in a batch. An odd number of cache lines, because a texel is gathered from
// all images, and lines at a distance of a power of two compete for the same place in the cache.
std::size_t batchStride(std::size_t imageBytes) {
  constexpr std::size_t kLine = 64;
  return ((imageBytes + kLine - 1) / kLine | 1) * kLine;
}

// `images[pair * imageStride + texel * 3 + rgb]` to `out[texel * texelStride + pair * 3 + rgb]`.
void transpose(const std::uint8_t* images, std::size_t imageStride, std::size_t pairs, std::size_t texels,
               std::uint8_t* out, std::size_t texelStride) {
  constexpr std::size_t kTileTexels = 64;
  tbb::parallel_for(std::size_t{0}, (texels + kTileTexels - 1) / kTileTexels, [=](std::size_t tile) {
    const std::size_t end = std::min((tile + 1) * kTileTexels, texels);
    for (std::size_t texel = tile * kTileTexels; texel < end; ++texel) {
      const std::uint8_t* from = images + texel * 3;
      std::uint8_t* to = out + texel * texelStride;
      for (std::size_t pair = 0; pair < pairs; ++pair)
        std::memcpy(to + pair * 3, from + pair * imageStride, 3);
    }
  });
}

}  // namespace

Result<std::unique_ptr<BtfSource>> ImageBtfSource::create(BtfDescription description,
                                                          std::unique_ptr<FileCollection> files,
                                                          std::vector<int> fileOfPair, std::string where) {
  std::unique_ptr<ImageBtfSource> source(new ImageBtfSource);
  source->description_ = std::move(description);
  source->files_ = std::move(files);
  source->fileOfPair_ = std::move(fileOfPair);
  source->where_ = std::move(where);

  const int first = source->fileOfPair_.front();
  WEFT_TRY(const std::vector<std::uint8_t> bytes, source->files_->read(first));
  WEFT_TRY(const PhotographHeader header, photographHeader(bytes, source->whereOf(first)));
  // Before anyone takes memory for so many texels, their number is proved.
  WEFT_TRY_VOID(decodeImage(bytes, source->whereOf(first)));
  source->description_.width = header.size.width;
  source->description_.height = header.size.height;
  source->description_.storedAsBytes = true;
  source->description_.cosineInData = true;  // photographs of an irradiated surface
  return source;
}

std::string ImageBtfSource::whereOf(int file) const {
  return where_ + ": " + files_->names()[static_cast<std::size_t>(file)];
}

Result<void> ImageBtfSource::readRows(int firstRow, int rowCount, SampleRows& out) const {
  const BtfDescription& d = description_;
  WEFT_EXPECT(firstRow >= 0 && rowCount > 0 && firstRow + rowCount <= d.height, "the rows exist");
  WEFT_TRY_VOID(out.allocate(d, rowCount));
  const std::size_t imageBytes = d.texels() * 3;
  const std::size_t stride = batchStride(imageBytes);
  const std::size_t pairsAtOnce = std::clamp<std::size_t>(kBatchBytes / stride, 1, out.pairs());
  const std::unique_ptr<std::uint8_t[]> batch(new (std::nothrow) std::uint8_t[pairsAtOnce * stride]);
  if (!batch) return fail("there is no memory for decoded images", where_);

  const std::size_t width = static_cast<std::size_t>(d.width);
  const std::uint8_t* rows = batch.get() + static_cast<std::size_t>(firstRow) * width * 3;
  for (std::size_t first = 0; first < out.pairs(); first += pairsAtOnce) {
    const std::size_t count = std::min(pairsAtOnce, out.pairs() - first);
    WEFT_TRY_VOID(parallelTry(static_cast<int>(count), [&](int index) -> Result<void> {
      const std::size_t i = static_cast<std::size_t>(index);
      const int file = fileOfPair_[first + i];
      WEFT_TRY(const std::vector<std::uint8_t> bytes, files_->read(file));
      return decodePhotograph(bytes, {d.width, d.height}, std::span(batch.get() + i * stride, imageBytes),
                              whereOf(file));
    }));
    transpose(rows, stride, count, static_cast<std::size_t>(rowCount) * width, out.bytes().data() + first * 3,
              out.pairs() * 3);
  }
  return {};
}

}  // namespace weft
