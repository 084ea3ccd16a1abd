#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "ColorPrimaries.h"
#include "ImageHeader.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/io/WithinMemory.h"

namespace weft {
namespace {

struct Rgbe {
  std::uint8_t r, g, b, e;
};

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Reads on through the bytes; past their end it fails once and for all.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    const auto end = std::ranges::find_if(bytes, [](std::uint8_t c) { return c == '\n' || c == '\r'; });
    if (end != bytes.end() && *end == '\r' && end + 1 != bytes.end() && end[1] != '\n') lineEnd_ = '\r';
  }

  bool failed() const { return failed_; }
  std::size_t left() const { return bytes_.size(); }
  std::span<const std::uint8_t> rest() const { return bytes_; }
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
  /// Up to a line's end, which is taken along: of the kind that the first line has. Without blanks
  /// around.
  std::string_view line() {
    const char* begin = reinterpret_cast<const char*>(bytes_.data());
    const void* end = bytes_.empty() ? nullptr : std::memchr(begin, lineEnd_, bytes_.size());
    if (!end) {
      failed_ = true;
      return {};
    }
    const std::string_view text(begin, static_cast<std::size_t>(static_cast<const char*>(end) - begin));
    bytes_ = bytes_.subspan(text.size() + 1);
    return trimmed(text);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool failed_ = false;
  char lineEnd_ = '\n';
};

/// Numbers with blanks between them; none where there are more, fewer or other things.
template <std::size_t count>
std::optional<std::array<double, count>> numbersOf(std::string_view text) {
  std::array<double, count> numbers{};
  for (double& number : numbers) {
    text = trimmed(text);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return trimmed(text).empty() ? std::optional(numbers) : std::nullopt;
}

/// "-Y HEIGHT" or one of its kin: the numbers, from the top, that scan lines or the pixels of one
/// are counted by.
struct Axis {
  char name = 'Y';
  bool increasing = false;
  int count = 0;
};

struct Header {
  Axis lines;   ///< of which one follows the other
  Axis pixels;  ///< of a line
  glm::dvec3 exposure{1.0};
  ColorPrimaries primaries;

  int width() const { return lines.name == 'X' ? lines.count : pixels.count; }
  int height() const { return lines.name == 'X' ? pixels.count : lines.count; }
};

std::optional<Axis> takeAxis(std::string_view& line) {
  line = trimmed(line);
  if (line.size() < 3 || (line[0] != '-' && line[0] != '+') || (line[1] != 'X' && line[1] != 'Y') ||
      !isBlank(line[2]))
    return std::nullopt;
  Axis axis{line[1], line[0] == '+', 0};
  line = trimmed(line.substr(2));
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), axis.count);
  if (error != std::errc()) return std::nullopt;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return axis;
}

/// "-Y HEIGHT +X WIDTH": false of what is no such line.
bool readSize(std::string_view line, Header& header) {
  const auto lines = takeAxis(line), pixels = takeAxis(line);
  if (!lines || !pixels || lines->name == pixels->name || !line.empty()) return false;
  header.lines = *lines;
  header.pixels = *pixels;
  return true;
}

/// "NAME=VALUE", with blanks around both.
Result<void> readVariable(std::string_view line, Header& header, const std::string& where,
                          std::vector<std::string>& warnings) {
  const std::size_t equals = std::min(line.find('='), line.size());
  const std::string_view name = trimmed(line.substr(0, equals));
  const std::string_view value = trimmed(line.substr(std::min(equals + 1, line.size())));
  if (name == "FORMAT" && value != "32-bit_rle_rgbe")
    return fail("the picture is not in RGBE", where, "convert it, for example to OpenEXR");
  if (name == "EXPOSURE")
    if (const auto factor = numbersOf<1>(value); factor && (*factor)[0] > 0.0)
      header.exposure *= (*factor)[0];
  if (name == "COLORCORR")
    if (const auto f = numbersOf<3>(value); f && (*f)[0] > 0.0 && (*f)[1] > 0.0 && (*f)[2] > 0.0)
      header.exposure *= glm::dvec3((*f)[0], (*f)[1], (*f)[2]);
  const auto isNotZero = [](double number) { return number != 0.0; };
  if (name == "PRIMARIES")  // Photoshop writes eight zeros
    if (const auto p = numbersOf<8>(value); p && std::ranges::any_of(*p, isNotZero))
      header.primaries = {{(*p)[0], (*p)[1]}, {(*p)[2], (*p)[3]}, {(*p)[4], (*p)[5]}, {(*p)[6], (*p)[7]}};
  if (name == "GAMMA")
    if (const auto gamma = numbersOf<1>(value); gamma && (*gamma)[0] != 1.0)
      warnings.emplace_back("the gamma of its header is ignored: radiance is linear");
  return {};
}

/// The broken header of ATRIUM's pictures says columns first, but rows follow, the lowest first. A
/// square picture of that header is taken for such a one, and one whose lines say that they are as
/// long as rows.
void mendOrder(std::span<const std::uint8_t> data, Header& header, std::vector<std::string>& warnings) {
  if (header.lines.name != 'X' || !header.lines.increasing || header.pixels.increasing) return;
  const bool saysRow =
      data.size() >= 4 && data[0] == 2 && data[1] == 2 && data[2] * 256 + data[3] == header.lines.count;
  if (!saysRow && header.lines.count != header.pixels.count) return;
  std::swap(header.lines, header.pixels);
  header.lines.increasing = true;
  warnings.emplace_back("its header says columns first, but rows from the lowest up are read");
}

Result<Header> readHeader(ByteReader& reader, const std::string& where, std::vector<std::string>& warnings) {
  Header header;
  if (!reader.line().starts_with("#?")) return fail("this is not a Radiance picture", where);
  bool isRead = false, isOver = false;
  std::string_view line;
  while (!isRead && !reader.failed()) {
    line = reader.line();
    isRead = readSize(line, header);
    if (isRead || line.starts_with('#')) continue;
    if (isOver && !line.empty()) break;
    isOver = isOver || line.empty();
    WEFT_TRY_VOID(readVariable(line, header, where, warnings));
  }
  if (reader.failed()) return fail("the Radiance picture is truncated", where);
  if (!isRead)
    return fail(fmt::format("a picture of \"{}\" is not supported", line.substr(0, 60)), where,
                "-Y HEIGHT +X WIDTH is expected");
  WEFT_TRY_VOID(checkImageSize(header.width(), header.height(), where));
  mendOrder(reader.rest(), header, warnings);
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

/// Whole pixels, of which (1, 1, 1, n) repeats the one before n times; several in a row count in
/// base 256.
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

/// Fails where a row is not there, so that this is known before memory is taken for pixels.
Result<void> checkRows(ByteReader reader, const Header& header, const std::string& where) {
  std::vector<Rgbe> row(static_cast<std::size_t>(header.pixels.count));
  for (int i = 0; i < header.lines.count; ++i) {
    if (readRow(reader, row)) continue;
    return fail(
        fmt::format("row {} of the Radiance picture is {}", i, reader.failed() ? "truncated" : "damaged"),
        where);
  }
  return {};
}

/// Where the n-th of an axis lies, counted from the left or the top.
int placeOf(const Axis& axis, int n) {
  const bool isForward = axis.increasing == (axis.name == 'X');
  return isForward ? n : axis.count - 1 - n;
}

FloatImage readPixels(ByteReader reader, const Header& header) {
  FloatImage image(header.width(), header.height(), {"R", "G", "B"});
  std::vector<Rgbe> row(static_cast<std::size_t>(header.pixels.count));
  const glm::vec3 exposure(header.exposure);
  for (int i = 0; i < header.lines.count; ++i) {
    readRow(reader, row);
    for (int j = 0; j < header.pixels.count; ++j) {
      const Rgbe pixel = row[static_cast<std::size_t>(j)];
      if (pixel.e == 0) continue;
      int x = placeOf(header.pixels, j), y = placeOf(header.lines, i);
      if (header.lines.name == 'X') std::swap(x, y);
      const glm::vec3 rgb = std::ldexp(1.0f, pixel.e - 136) / exposure * glm::vec3(pixel.r, pixel.g, pixel.b);
      std::ranges::copy(std::array{rgb.x, rgb.y, rgb.z}, image.texel(x, y).begin());
    }
  }
  return image;
}

}  // namespace

Result<FloatImage> decodeRadiance(std::span<const std::uint8_t> bytes, const std::string& where,
                                  std::vector<std::string>& warnings) {
  ByteReader reader(bytes);
  WEFT_TRY(const Header header, readHeader(reader, where, warnings));
  const auto matrix = toRec709(header.primaries);
  if (!matrix) warnings.emplace_back("its primaries are no colours; Rec. 709 is assumed");
  return withinMemory(where, [&]() -> Result<FloatImage> {
    WEFT_TRY_VOID(checkRows(reader, header, where));
    FloatImage image = readPixels(reader, header);
    if (matrix) transformColors(image, *matrix);
    return image;
  });
}

}  // namespace weft
