#include "ImageBtfSource.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <new>

#include "weft/core/Checksum.h"
#include "weft/core/Contract.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ParallelTry.h"

namespace weft {
namespace {

// Images wait as a batch for being transposed, so that what is written to a texel is a long run.
constexpr std::size_t kBatchBytes = std::size_t{128} << 20;

// Bytes from an image to the next in a batch. An odd number of cache lines, because a texel is
// gathered from all images, and lines at a distance of a power of two compete for the same place in
// the cache.
std::size_t batchStride(std::size_t imageBytes) {
  constexpr std::size_t kLine = 64;
  return ((imageBytes + kLine - 1) / kLine | 1) * kLine;
}

// `images[pair * imageStride + texel * 3 + rgb]` to `out[texel * texelStride + pair * 3 + rgb]`.
template <class Value, class Sample, class Convert>
void transpose(const Value* images, std::size_t imageStride, std::size_t pairs, std::size_t texels,
               Sample* out, std::size_t texelStride, const Convert& convert) {
  constexpr std::size_t kTileTexels = 64;
  tbb::parallel_for(std::size_t{0}, (texels + kTileTexels - 1) / kTileTexels, [=](std::size_t tile) {
    const std::size_t end = std::min((tile + 1) * kTileTexels, texels);
    for (std::size_t texel = tile * kTileTexels; texel < end; ++texel) {
      const Value* from = images + texel * 3;
      Sample* to = out + texel * texelStride;
      for (std::size_t pair = 0; pair < pairs; ++pair, to += 3, from += imageStride)
        for (std::size_t c = 0; c < 3; ++c) to[c] = convert(from[c]);
    }
  });
}

std::vector<float> linearWords(Encoding encoding) {
  std::vector<float> linear(65536);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = decode(encoding, static_cast<float>(i) / 65535.0f);
  return linear;
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
  source->description_.storedAsBytes = !header.wide;
  if (header.wide) source->linearOfWord_ = linearWords(source->description_.encoding);
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
  if (d.storedAsBytes)
    return readSamples<std::uint8_t>(firstRow, rowCount, out.bytes().data(),
                                     [](std::uint8_t value) { return value; });
  const float* linear = linearOfWord_.data();
  return readSamples<std::uint16_t>(firstRow, rowCount, out.floats().data(),
                                    [=](std::uint16_t value) { return linear[value]; });
}

template <class Value, class Sample, class Convert>
Result<void> ImageBtfSource::readSamples(int firstRow, int rowCount, Sample* out,
                                         const Convert& convert) const {
  const BtfDescription& d = description_;
  const std::size_t imageValues = d.texels() * 3;
  const std::size_t stride = batchStride(imageValues * sizeof(Value)) / sizeof(Value);
  const std::size_t pairs = fileOfPair_.size();
  const std::size_t pairsAtOnce = std::clamp<std::size_t>(kBatchBytes / (stride * sizeof(Value)), 1, pairs);
  const std::unique_ptr<Value[]> batch(new (std::nothrow) Value[pairsAtOnce * stride]);
  if (!batch) return fail("there is no memory for decoded images", where_);

  const std::size_t width = static_cast<std::size_t>(d.width);
  const Value* rows = batch.get() + static_cast<std::size_t>(firstRow) * width * 3;
  for (std::size_t first = 0; first < pairs; first += pairsAtOnce) {
    const std::size_t count = std::min(pairsAtOnce, pairs - first);
    WEFT_TRY_VOID(parallelTry(static_cast<int>(count), [&](int index) -> Result<void> {
      const std::size_t i = static_cast<std::size_t>(index);
      const int file = fileOfPair_[first + i];
      WEFT_TRY(const std::vector<std::uint8_t> bytes, files_->read(file));
      return decodePhotograph(bytes, {d.width, d.height}, std::span(batch.get() + i * stride, imageValues),
                              whereOf(file));
    }));
    transpose(rows, stride, count, static_cast<std::size_t>(rowCount) * width, out + first * 3, pairs * 3,
              convert);
  }
  return {};
}

// Of the files: that saves decoding them.
Result<std::uint64_t> ImageBtfSource::checksum() const {
  std::vector<std::uint64_t> ofFiles(fileOfPair_.size());
  WEFT_TRY_VOID(parallelTry(static_cast<int>(ofFiles.size()), [&](int pair) -> Result<void> {
    const auto i = static_cast<std::size_t>(pair);
    WEFT_TRY(ofFiles[i], files_->checksum(fileOfPair_[i]));
    return {};
  }));
  return checksumOf(std::as_bytes(std::span(ofFiles)), description_.checksum());
}

}  // namespace weft
