#include "ExifOrientation.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft {
namespace {

constexpr std::uint32_t kOrientationTag = 0x0112;
constexpr std::uint32_t kShort = 3;
constexpr std::size_t kEntryBytes = 12;

/// Unsigned numbers of a TIFF structure; 0 beyond its end.
class TiffReader {
 public:
  explicit TiffReader(std::span<const std::uint8_t> bytes)
      : bytes_(bytes), bigEndian_(!bytes.empty() && bytes[0] == 'M') {}

  std::uint32_t number(std::size_t offset, std::size_t size) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | bytes_[offset + (bigEndian_ ? i : size - 1 - i)];
    return value;
  }
  bool startsWell() const {
    constexpr std::array<std::uint8_t, 2> kLittle{'I', 'I'}, kBig{'M', 'M'};
    return bytes_.size() >= 8 && std::ranges::equal(bytes_.first(2), bigEndian_ ? kBig : kLittle) &&
           number(2, 2) == 42;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool bigEndian_;
};

}  // namespace

Orientation exifOrientation(std::span<const std::uint8_t> exif) {
  const TiffReader tiff(exif);
  if (!tiff.startsWell()) return Orientation::Upright;
  const std::size_t directory = tiff.number(4, 4);
  const std::size_t entries = tiff.number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntryBytes;
    if (tiff.number(entry, 2) != kOrientationTag || tiff.number(entry + 2, 2) != kShort) continue;
    const std::uint32_t value = tiff.number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<Orientation>(value) : Orientation::Upright;
  }
  return Orientation::Upright;
}

}  // namespace weft
