#pragma once

#include <cstdint>
#include <span>

namespace weft {

/// How stored pixels are turned to stand upright, numbered as in EXIF (tag 0x0112).
enum class Orientation : std::uint8_t {
  Upright = 1,
  Mirrored = 2,
  UpsideDown = 3,
  MirroredUpsideDown = 4,
  Transposed = 5,
  TurnRight = 6,
  TransposedUpsideDown = 7,
  TurnLeft = 8,
};

/// Whether rows and columns change places.
inline bool swapsSides(Orientation orientation) {
  return orientation >= Orientation::Transposed;
}

/// The orientation in a block of EXIF (a TIFF header and its first directory). A block that has
/// none, or is damaged, leaves the image as it is stored.
Orientation exifOrientation(std::span<const std::uint8_t> exif);

}  // namespace weft
