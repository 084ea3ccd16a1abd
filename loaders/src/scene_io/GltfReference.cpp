#include "GltfReference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include "TinyGltf.h"
#include "weft/io/FileBytes.h"
#include "weft/io/FileName.h"

namespace weft {
namespace {

/// Whether a text starts so, in upper or lower case.
bool startsWith(std::string_view text, std::string_view lowerCase) {
  return text.size() >= lowerCase.size() &&
         std::equal(lowerCase.begin(), lowerCase.end(), text.begin(), [](char expected, char c) {
           return std::tolower(static_cast<unsigned char>(c)) == expected;
         });
}

/// With the %20 and the like resolved.
std::string percentDecoded(std::string_view uri) {
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char code = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3) {
      decoded.push_back(static_cast<char>(code));
      i += 2;
    } else {
      decoded.push_back(uri[i]);
    }
  }
  return decoded;
}

/// "data:image/png;base64,..." without what stands before the comma; types are told by the bytes
/// themselves.
Result<std::vector<std::uint8_t>> dataOf(const std::filesystem::path& file, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  const auto broken = [&](const char* why) {
    return fail("the embedded data " + shownUri(uri) + " " + why, file.string());
  };
  if (comma == std::string_view::npos) return broken("has no comma before its bytes");
  const std::string_view header = uri.substr(0, comma);
  std::string text = percentDecoded(uri.substr(comma + 1));
  const std::size_t last = header.rfind(';');
  if (last == std::string_view::npos || !startsWith(header.substr(last), ";base64"))
    return std::vector<std::uint8_t>(text.begin(), text.end());

  std::erase_if(text, [](unsigned char c) { return std::isspace(c); });
  const std::size_t end =
      text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/");
  if (end != std::string::npos && text.find_first_not_of('=', end) != std::string::npos)
    return broken("is not base64");
  text.resize(std::min(text.size(), end));
  std::vector<std::uint8_t> bytes;
  std::string type;
  // tinygltf knows a few headers only.
  if (text.size() > 1)
    tinygltf::DecodeDataURI(&bytes, type, "data:application/octet-stream;base64," + text, 0, false);
  return bytes;
}

bool isThere(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// The entry of a folder that has this name in another normal form of Unicode; the name where there
/// is none.
std::filesystem::path entryNamed(const std::filesystem::path& folder, const std::filesystem::path& name) {
  const std::string composed = composedName(name.string());
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored))
    if (composedName(entry->path().filename().string()) == composed) return entry->path().filename();
  return name;
}

/// The path with each part as the file system has it, in whichever normal form.
std::filesystem::path inAnyNormalForm(const std::filesystem::path& path) {
  std::filesystem::path found;
  for (const std::filesystem::path& part : path) {
    const std::filesystem::path folder = found.empty() ? "." : found;
    found /= isThere(found / part) ? part : entryNamed(folder, part);
  }
  return found;
}

}  // namespace

bool isDataUri(std::string_view uri) {
  return startsWith(uri, "data:");
}

std::string shownUri(std::string_view uri) {
  constexpr std::size_t kLongest = 200, kLongestHeader = 60;
  if (!isDataUri(uri) && uri.size() <= kLongest) return std::string(uri);
  const std::string_view start =
      isDataUri(uri) ? uri.substr(0, std::min(uri.find(','), kLongestHeader)) : uri.substr(0, kLongest);
  return fmt::format("{}... ({} characters)", start, uri.size());
}

Result<std::filesystem::path> resolveUri(const std::filesystem::path& file, const std::string& uri) {
  constexpr std::string_view kFileScheme = "file://";
  constexpr std::size_t kLongestPath = 4095;
  const auto noFile = [&] { return fail(fmt::format("\"{}\" names no file", shownUri(uri)), file.string()); };
  if (isDataUri(uri)) return noFile();
  std::string_view reference = uri;
  if (startsWith(uri, kFileScheme)) reference.remove_prefix(kFileScheme.size());
  if (reference.find("://") != std::string_view::npos)
    return fail(fmt::format("\"{}\" is no file, and Weft reads nothing else", shownUri(uri)), file.string(),
                "fetch it, and name the copy");
  std::string name = percentDecoded(reference);
  if (name.size() > kLongestPath || name.find('\0') != std::string::npos) return noFile();
  if (const std::filesystem::path path = file.parent_path() / name; isThere(path)) return path;
  // Exporters on Windows write backslashes.
  std::replace(name.begin(), name.end(), '\\', '/');
  return inAnyNormalForm(file.parent_path() / name);
}

Result<std::vector<std::uint8_t>> readUri(const std::filesystem::path& file, const std::string& uri,
                                          std::size_t limit) {
  if (isDataUri(uri)) return dataOf(file, uri);
  WEFT_TRY(const std::filesystem::path path, resolveUri(file, uri));
  return readFileBytes(path, limit);
}

}  // namespace weft
