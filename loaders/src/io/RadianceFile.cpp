#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "weft/io/EnvironmentFile.h"

namespace weft {
namespace {

constexpr int kLargestSide = 16384;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;

struct Rgbe {
  std::uint8_t r, g, b, e;
};

/// Reads on through the bytes; past their end it fails once and for all.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool failed() const { return failed_; }
  std::size_t left() const { return bytes_.size(); }
  std::uint8_t byte() {
    if (bytes_.empty()) {
      failed_ = true;
      return 0;
    }
    const std::uint8_t value = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return value;
  }
  Rgbe pixel() {
    Rgbe pixel{};
    pixel.r = byte();
    pixel.g = byte();
    pixel.b = byte();
    pixel.e = byte();
    return pixel;
  }
  /// Up to a line's end, which is taken along.
  std::string_view line() {
    const char* begin = reinterpret_cast<const char*>(bytes_.data());
    const void* end = bytes_.empty() ? nullptr : std::memchr(begin, '\n', bytes_.size());
    if (!end) {
      failed_ = true;
      return {};
    }
    const std::string_view text(begin, static_cast<std::size_t>(static_cast<const char*>(end) - begin));
    bytes_ = bytes_.subspan(text.size() + 1);
    return text.ends_with('\r') ? text.substr(0, text.size() - 1) : text;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool failed_ = false;
};

struct Header {
  int width = 0;
  int height = 0;
  float exposure = 1.0f;
};

/// "-Y HEIGHT +X WIDTH".
bool readSize(std::string_view line, Header& header) {
  const auto number = [&](std::string_view prefix, int& value) {
    if (!line.starts_with(prefix)) return false;
    line.remove_prefix(prefix.size());
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc()) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return true;
  };
  return number("-Y ", header.height) && number(" +X ", header.width) && line.empty();
}

Result<Header> readHeader(ByteReader& reader, const std::string& where) {
  Header header;
  if (!reader.line().starts_with("#?")) return fail("this is not a Radiance picture", where);
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
      return fail("the picture is not in RGBE", where, "convert it, for example to OpenEXR");
    if (line.starts_with("EXPOSURE=")) {
      const std::string_view text = line.substr(
          line.find_first_not_of(' ', 9) == line.npos ? line.size() : line.find_first_not_of(' ', 9));
      float exposure = 0.0f;
      if (std::from_chars(text.data(), text.data() + text.size(), exposure).ec == std::errc() &&
          exposure > 0.0f && std::isfinite(exposure))
        header.exposure *= exposure;
    }
  }
  const std::string_view size = reader.line();
  if (reader.failed()) return fail("the Radiance picture is truncated", where);
  if (!readSize(size, header))
    return fail(fmt::format("a picture of \"{}\" is not supported", size.substr(0, 60)), where,
                "rows must run down and columns to the right: -Y HEIGHT +X WIDTH");
  if (header.width < 1 || header.height < 1 || header.width > kLargestSide || header.height > kLargestSide ||
      std::int64_t{header.width} * header.height > kMostPixels)
    return fail(fmt::format("an image of {} x {} pixels is not supported", header.width, header.height),
                where, fmt::format("at most {} a side and {} in all", kLargestSide, kMostPixels));
  return header;
}

/// Runs of one component after another.
bool readNewRow(ByteReader& reader, std::vector<Rgbe>& row) {
  for (const auto component : {&Rgbe::r, &Rgbe::g, &Rgbe::b, &Rgbe::e})
    for (std::size_t x = 0; x < row.size();) {
      std::size_t count = reader.byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (reader.failed() || count == 0 || count > row.size() - x) return false;
      std::uint8_t value = run ? reader.byte() : std::uint8_t{0};
      for (; count > 0; --count) row[x++].*component = run ? value : reader.byte();
    }
  return !reader.failed();
}

/// Whole pixels, of which (1, 1, 1, n) repeats the one before n times; several in a row count in base 256.
bool readOldRow(ByteReader& reader, Rgbe first, std::vector<Rgbe>& row) {
  int shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    const Rgbe pixel = x == 0 ? first : reader.pixel();
    if (reader.failed()) return false;
    if (x > 0 && pixel.r == 1 && pixel.g == 1 && pixel.b == 1) {
      const std::size_t count = shift < 32 ? std::size_t{pixel.e} << shift : row.size();
      if (count > row.size() - x) return false;
      for (std::size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
      shift += 8;
      // A chain of empty repeats would never end a row.
      if (count == 0 && shift > 32) return false;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
  }
  return true;
}

bool readRow(ByteReader& reader, std::vector<Rgbe>& row) {
  const Rgbe first = reader.pixel();
  const bool isNew = row.size() >= 8 && row.size() < 32768 && first.r == 2 && first.g == 2 &&
                     std::size_t{first.b} * 256 + first.e == row.size();
  return isNew ? readNewRow(reader, row) : readOldRow(reader, first, row);
}

}  // namespace

Result<FloatImage> decodeRadiance(std::span<const std::uint8_t> bytes, const std::string& where) {
  ByteReader reader(bytes);
  WEFT_TRY(const Header header, readHeader(reader, where));
  // A row takes at least a run of 127 for every component, or an old row's few repeats.
  if (reader.left() < static_cast<std::size_t>(header.height) * 4)
    return fail("the Radiance picture is truncated", where);
  FloatImage image(header.width, header.height, {"R", "G", "B"});
  std::vector<Rgbe> row(static_cast<std::size_t>(header.width));
  for (int y = 0; y < header.height; ++y) {
    if (!readRow(reader, row))
      return fail(fmt::format("row {} of the Radiance picture is damaged", y), where);
    for (int x = 0; x < header.width; ++x) {
      const Rgbe pixel = row[static_cast<std::size_t>(x)];
      if (pixel.e == 0) continue;
      const float unit = std::ldexp(1.0f, pixel.e - 136) / header.exposure;
      image.at(x, y, 0) = unit * static_cast<float>(pixel.r);
      image.at(x, y, 1) = unit * static_cast<float>(pixel.g);
      image.at(x, y, 2) = unit * static_cast<float>(pixel.b);
    }
  }
  return image;
}

}  // namespace weft
