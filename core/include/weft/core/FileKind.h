#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "weft/core/Result.h"

namespace weft {

/// What a file is by its first bytes, whatever its name says.
enum class FileKind {
  Unknown,  ///< none of these
  Empty,
  Text,  ///< printable ASCII, or with a byte order mark; none of the texts below
  Html,
  GitLfsPointer,
  Json,  ///< a text that begins with a brace: glTF scenes
  Glb,
  Zip,
  Archive,  ///< gzip, bzip2, xz, Zstandard, 7-Zip, RAR, tar
  Png,
  Jpeg,
  Exr,
  Radiance,  ///< .hdr
  Tiff,      ///< also many cameras' raw files
  Webp,
  Ktx2,
  OtherImage,  ///< GIF, HEIF, AVIF, Photoshop, JPEG XL, JPEG 2000
  Ptm,
  HshRti,   ///< .rti of RTIBuilder and relight
  BonnBtf,  ///< .btf, .bdi
  Hdf5,
};

/// So many first bytes of a file tell its kind.
constexpr std::size_t kFileKindBytes = 512;

/// The kind of a file that begins with these bytes: all it has, or the first kFileKindBytes.
FileKind fileKind(std::span<const std::uint8_t> firstBytes);

/// The kind of a regular file; Unknown where it is none, is missing or cannot be read.
FileKind fileKind(const std::filesystem::path& file);

/// With its article, for a message: "a PNG image"; empty for Unknown.
std::string_view name(FileKind kind);

/// For a reader that was given a file of another kind: "WHERE: this is a PNG image, not EXPECTED
/// (which program takes PNG images, or what to do)". `expected` has its article: "an OpenEXR file".
tl::unexpected<Error> failOtherKind(FileKind actual, std::string_view expected, std::string where);

}  // namespace weft
