#include "weft/core/FileKind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

namespace weft {
namespace {

using namespace std::literals;

struct Signature {
  FileKind kind;
  std::string_view bytes;
  std::size_t offset = 0;
};

constexpr std::array kSignatures{
    Signature{FileKind::Html, "<!doctype html"},
    Signature{FileKind::Html, "<html"},
    Signature{FileKind::GitLfsPointer, "version https://git-lfs"},
    Signature{FileKind::Json, "{"},
    Signature{FileKind::Glb, "glTF"},
    Signature{FileKind::Zip, "PK\3\4"},
    Signature{FileKind::Zip, "PK\5\6"},  // without an entry
    Signature{FileKind::Zip, "PK\7\10"},
    Signature{FileKind::Archive, "\x1f\x8b"},
    Signature{FileKind::Archive, "BZh"},
    Signature{FileKind::Archive,
              "\xfd"
              "7zXZ"},
    Signature{FileKind::Archive, "\x28\xb5\x2f\xfd"},
    Signature{FileKind::Archive, "7z\xbc\xaf\x27\x1c"},
    Signature{FileKind::Archive, "Rar!\x1a\x07"},
    Signature{FileKind::Archive, "ustar", 257},
    Signature{FileKind::Png, "\x89PNG\r\n\x1a\n"},
    Signature{FileKind::Jpeg, "\xff\xd8\xff"},
    Signature{FileKind::Exr, "\x76\x2f\x31\x01"},
    Signature{FileKind::Radiance, "#?"},  // and the program's name: RADIANCE, RGBE, AUTOPANO
    Signature{FileKind::Tiff, "II*\0"sv},
    Signature{FileKind::Tiff, "II+\0"sv},
    Signature{FileKind::Tiff, "MM\0*"sv},
    Signature{FileKind::Tiff, "MM\0+"sv},
    Signature{FileKind::Webp, "WEBP", 8},
    Signature{FileKind::Ktx2, "\xabKTX 20\xbb"},
    Signature{FileKind::OtherImage, "GIF8"},
    Signature{FileKind::OtherImage, "ftypheic", 4},
    Signature{FileKind::OtherImage, "ftypmif1", 4},
    Signature{FileKind::OtherImage, "ftypavif", 4},
    Signature{FileKind::OtherImage, "ftypcrx ", 4},  // Canon's CR3
    Signature{FileKind::OtherImage, "8BPS"},
    Signature{FileKind::OtherImage, "JXL ", 4},
    Signature{FileKind::OtherImage, "jP  ", 4},
    Signature{FileKind::Ptm, "PTM_"},
    Signature{FileKind::HshRti, "#HSH"},
    Signature{FileKind::BonnBtf, "!DFMF"},
    Signature{FileKind::BonnBtf, "!FMF"},
    Signature{FileKind::BonnBtf, "!PVF"},
    Signature{FileKind::BonnBtf, "!BDIF"},
    Signature{FileKind::Hdf5, "\x89HDF\r\n\x1a\n"},
};

struct KindWords {
  FileKind kind;
  std::string_view name;
  std::string_view hint;
};

constexpr std::string_view kConvert = "convert it to PNG or JPEG";
constexpr std::string_view kPhotographs =
    "photographs are read as a folder or zip of angle-named images, or with a light list (.lp)";
constexpr std::string_view kScene = "weft-render draws glTF scenes";
constexpr std::string_view kFitted =
    "another program's fit, which Weft does not read: fit the photographs it was made from";

constexpr std::array kWords{
    KindWords{FileKind::Unknown, "", ""},
    KindWords{FileKind::Empty, "an empty file", "copy or download it again"},
    KindWords{FileKind::Text, "a text", ""},
    KindWords{FileKind::Html, "a web page", "download the file itself"},
    KindWords{FileKind::GitLfsPointer, "a pointer of Git LFS",
              "fetch the file that it stands for: git lfs pull"},
    KindWords{FileKind::Json, "a JSON text, as glTF scenes are", kScene},
    KindWords{FileKind::Glb, "a glTF scene (.glb)", kScene},
    KindWords{FileKind::Zip, "a zip",
              "weft-info, weft-fit and weft-compare read a zip of a measurement's images"},
    KindWords{FileKind::Archive, "an archive other than a zip", "unpack it"},
    KindWords{FileKind::Png, "a PNG image", kPhotographs},
    KindWords{FileKind::Jpeg, "a JPEG image", kPhotographs},
    KindWords{
        FileKind::Exr, "an OpenEXR image",
        "weft-info, weft-eval and weft-render --material take reflectance fields (.rf.exr), weft-render "
        "--env takes environments"},
    KindWords{FileKind::Radiance, "a Radiance image (.hdr)", "weft-render --env takes it as environment"},
    KindWords{FileKind::Tiff, "a TIFF or a camera's raw image", kConvert},
    KindWords{FileKind::Webp, "a WebP image", kConvert},
    KindWords{FileKind::Ktx2, "a KTX 2 texture", kConvert},
    KindWords{FileKind::OtherImage, "an image of another format", kConvert},
    KindWords{FileKind::Ptm, "a polynomial texture map (.ptm)", kFitted},
    KindWords{FileKind::HshRti, "an RTI file of HSH coefficients (.rti)", kFitted},
    KindWords{FileKind::BonnBtf, "a compressed BTF of Bonn's (.btf, .bdi)",
              "which Weft does not read: unpack it to angle-named images"},
    KindWords{FileKind::Hdf5, "an HDF5 file", "which Weft does not read: unpack it to angle-named images"},
};

const KindWords& wordsOf(FileKind kind) {
  return kWords[static_cast<std::size_t>(kind)];
}

static_assert(std::ranges::is_sorted(kWords, {}, &KindWords::kind) &&
              kWords.size() == static_cast<std::size_t>(FileKind::Hdf5) + 1);

char lowerCase(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// What HTML and JSON may have before their first word.
std::string_view withoutStart(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

bool begins(std::string_view text, const Signature& signature) {
  if (signature.kind != FileKind::Html && signature.kind != FileKind::Json)
    return text.size() > signature.offset && text.substr(signature.offset).starts_with(signature.bytes);
  const std::string_view start = withoutStart(text).substr(0, signature.bytes.size());
  return std::ranges::equal(start, signature.bytes, {}, lowerCase);
}

bool isText(std::string_view text) {
  for (const std::string_view mark : {"\xef\xbb\xbf"sv, "\xff\xfe"sv, "\xfe\xff"sv})
    if (text.starts_with(mark)) return true;
  return std::ranges::all_of(text, [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); });
}

}  // namespace

FileKind fileKind(std::span<const std::uint8_t> firstBytes) {
  const std::string_view text(reinterpret_cast<const char*>(firstBytes.data()),
                              std::min(firstBytes.size(), kFileKindBytes));
  if (text.empty()) return FileKind::Empty;
  const auto known = std::ranges::find_if(kSignatures, [&](const Signature& s) { return begins(text, s); });
  if (known != kSignatures.end()) return known->kind;
  return isText(text) ? FileKind::Text : FileKind::Unknown;
}

FileKind fileKind(const std::filesystem::path& file) {
  std::error_code error;
  // a FIFO would wait
  if (!std::filesystem::is_regular_file(file, error)) return FileKind::Unknown;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return FileKind::Unknown;
  std::vector<std::uint8_t> bytes(kFileKindBytes);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (stream.bad()) return FileKind::Unknown;
  return fileKind(std::span(bytes).first(static_cast<std::size_t>(stream.gcount())));
}

std::string_view name(FileKind kind) {
  return wordsOf(kind).name;
}

tl::unexpected<Error> failOtherKind(FileKind actual, std::string_view expected, std::string where) {
  const KindWords& words = wordsOf(actual);
  const std::string what = words.name.empty() ? fmt::format("this is not {}", expected)
                                              : fmt::format("this is {}, not {}", words.name, expected);
  return fail(what, std::move(where), std::string(words.hint));
}

}  // namespace weft
