#include "FittedRows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "weft/core/AtomicFile.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

constexpr std::string_view kExtension = ".rows";

// What a file begins with; its fingerprint and the rows' bytes follow.
struct Header {
  char magic[8] = {'w', 'e', 'f', 't', 'r', 'o', 'w', 's'};
  std::uint64_t fingerprintBytes = 0;
  std::uint64_t rowsBytes = 0;
  std::uint64_t checksum = 0;  ///< of the rows
  std::int32_t firstRow = 0;
  std::int32_t rowCount = 0;
};

// FNV-1a of words of eight bytes. A file that is renamed before its blocks reach the disk may come out of a
// power cut full of zeros.
std::uint64_t checksumOf(std::span<const std::byte> bytes, std::uint64_t start) {
  std::uint64_t checksum = start;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min<std::size_t>(8, bytes.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min<std::size_t>(8, bytes.size()));
    checksum = (checksum ^ word) * 0x100000001b3u;
  }
  return checksum;
}

}  // namespace

FittedRows::FittedRows(int width, int height, const FieldFormula& formula, std::filesystem::path folder,
                       std::string fingerprint)
    : shared(width, height, formula.model().sharedChannels()),
      errors(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      folder_(std::move(folder)),
      fingerprint_(std::move(fingerprint)),
      done_(static_cast<std::size_t>(height), false),
      saved_(done_) {
  if (formula.layerCount() > 0)
    layers = FloatImage(width, height, formula.model().layerChannels(), formula.layerCount());
}

void FittedRows::setDone(int firstRow, int count) {
  std::fill_n(done_.begin() + firstRow, count, true);
}

std::vector<RowRange> FittedRows::takeUnsaved() {
  std::vector<RowRange> ranges;
  for (std::size_t row = 0; row < done_.size() && !folder_.empty(); ++row) {
    if (!done_[row] || saved_[row]) continue;
    saved_[row] = true;
    const int number = static_cast<int>(row);
    if (ranges.empty() || ranges.back().first + ranges.back().count != number) ranges.push_back({number, 0});
    ++ranges.back().count;
  }
  return ranges;
}

std::vector<std::span<std::byte>> FittedRows::bytesOf(RowRange range) {
  std::vector<std::span<std::byte>> bytes;
  const auto rowsOf = [&](FloatImage& image, int layer) {
    const std::size_t rowFloats =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.channelCount());
    bytes.push_back(std::as_writable_bytes(
        image.layerValues(layer).subspan(static_cast<std::size_t>(range.first) * rowFloats,
                                         static_cast<std::size_t>(range.count) * rowFloats)));
  };
  rowsOf(shared, 0);
  for (int layer = 0; layer < layers.layers(); ++layer) rowsOf(layers, layer);
  const auto width = static_cast<std::size_t>(shared.width());
  bytes.push_back(std::as_writable_bytes(std::span(errors).subspan(
      static_cast<std::size_t>(range.first) * width, static_cast<std::size_t>(range.count) * width)));
  return bytes;
}

Result<void> FittedRows::save(RowRange range) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) return fail("the folder of finished rows cannot be made: " + error.message(), folder_.string());
  const std::vector<std::span<std::byte>> rows = const_cast<FittedRows*>(this)->bytesOf(range);
  Header header;
  header.firstRow = range.first;
  header.rowCount = range.count;
  header.fingerprintBytes = fingerprint_.size();
  for (std::span<const std::byte> bytes : rows) {
    header.rowsBytes += bytes.size();
    header.checksum = checksumOf(bytes, header.checksum);
  }
  WEFT_TRY(AtomicFile file,
           AtomicFile::create(folder_ / fmt::format("{:06}-{:06}{}", range.first,
                                                    range.first + range.count - 1, kExtension)));
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(reinterpret_cast<const char*>(&header), sizeof header);
  stream.write(fingerprint_.data(), static_cast<std::streamsize>(fingerprint_.size()));
  for (std::span<const std::byte> bytes : rows)
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) return fail("finished rows cannot be written", folder_.string(), "is the disk full?");
  return file.commit();
}

Result<void> FittedRows::load() {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error))
    if (entry.path().extension() == kExtension) files.push_back(entry.path());
  std::ranges::sort(files);
  for (const std::filesystem::path& file : files) WEFT_TRY_VOID(loadFile(file));
  return {};
}

Result<void> FittedRows::loadFile(const std::filesystem::path& path) {
  const auto damaged = [&](std::string_view what) {
    return fail(fmt::format("finished rows are damaged: {}", what), path.string(), "delete this file");
  };
  std::size_t largest = sizeof(Header) + (std::size_t{1} << 20);
  for (std::span<const std::byte> bytes : bytesOf({0, shared.height()})) largest += bytes.size();
  WEFT_TRY(const std::vector<std::uint8_t> contents, readFileBytes(path, largest));
  std::span<const std::byte> rest = std::as_bytes(std::span(contents));
  Header header;
  if (rest.size() < sizeof header) return damaged("too short");
  const Header expected;
  std::memcpy(&header, rest.data(), sizeof header);
  rest = rest.subspan(sizeof header);
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0) return damaged("not such a file");
  if (header.fingerprintBytes > rest.size()) return damaged("too short");
  const std::string_view fingerprint(reinterpret_cast<const char*>(rest.data()), header.fingerprintBytes);
  rest = rest.subspan(header.fingerprintBytes);
  if (fingerprint != fingerprint_)
    return fail(
        fmt::format("these finished rows are of another fit: {} instead of {}", fingerprint, fingerprint_),
        path.string(), "fit with the same options, or without --resume");
  if (header.firstRow < 0 || header.rowCount < 1 || header.rowCount > shared.height() ||
      header.firstRow > shared.height() - header.rowCount)
    return damaged("rows that do not exist");
  const std::vector<std::span<std::byte>> rows = bytesOf({header.firstRow, header.rowCount});
  std::size_t wanted = 0;
  for (std::span<const std::byte> bytes : rows) wanted += bytes.size();
  if (header.rowsBytes != wanted || rest.size() != wanted) return damaged("wrong size");
  std::uint64_t checksum = 0;
  for (std::span<const std::byte> bytes = rest; std::span<const std::byte> part : rows) {
    checksum = checksumOf(bytes.first(part.size()), checksum);
    bytes = bytes.subspan(part.size());
  }
  if (checksum != header.checksum) return damaged("wrong checksum");
  for (std::span<std::byte> bytes : rows) {
    std::memcpy(bytes.data(), rest.data(), bytes.size());
    rest = rest.subspan(bytes.size());
  }
  setDone(header.firstRow, header.rowCount);
  std::fill_n(saved_.begin() + header.firstRow, header.rowCount, true);
  return {};
}

void FittedRows::remove() const {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

}  // namespace weft
