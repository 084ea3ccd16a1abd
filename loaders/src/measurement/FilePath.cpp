#include "FilePath.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace weft {
namespace {

constexpr std::size_t kLongestExtension = 5;

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

template <std::size_t N>
bool isOneOf(const std::string& word, const std::array<std::string_view, N>& words) {
  return std::ranges::find(words, word) != words.end();
}

bool isClutterPart(std::string_view part) {
  const std::string name = lowerCase(part);
  return name.starts_with('.') || name == "__macosx" || name == "thumbs" || name == "thumbnails";
}

}  // namespace

std::string_view folderOf(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string_view() : path.substr(0, slash);
}

std::string_view fileNameOf(std::string_view path) {
  return path.substr(path.rfind('/') + 1);
}

std::string_view stemOf(std::string_view path) {
  const std::string_view name = fileNameOf(path);
  return name.substr(0, name.size() - extensionOf(name).size());
}

std::string extensionOf(std::string_view path) {
  const std::string_view name = fileNameOf(path);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == name.size()) return {};
  const std::string_view extension = name.substr(dot);
  const bool isWord = extension.size() <= kLongestExtension && isLetter(extension[1]) &&
                      extension.find(' ') == std::string_view::npos;
  return isWord ? lowerCase(extension) : std::string();
}

bool isReadableImage(std::string_view path) {
  constexpr std::array<std::string_view, 5> kReadable{".jpg", ".jpeg", ".jpe", ".jfif", ".png"};
  return isOneOf(extensionOf(path), kReadable);
}

bool isAnyImage(std::string_view path) {
  constexpr std::array<std::string_view, 18> kImages{".exr",  ".hdr",  ".tif",  ".tiff", ".bmp", ".gif",
                                                     ".webp", ".heic", ".avif", ".jp2",  ".jxl", ".dng",
                                                     ".cr2",  ".cr3",  ".nef",  ".arw",  ".raf", ".orf"};
  return isReadableImage(path) || isOneOf(extensionOf(path), kImages);
}

bool isClutter(std::string_view path) {
  for (;;) {
    const std::size_t slash = path.find('/');
    if (isClutterPart(path.substr(0, slash))) return true;
    if (slash == std::string_view::npos) return false;
    path.remove_prefix(slash + 1);
  }
}

std::string firstOf(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 3;
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kNamed));
  const std::string named = fmt::format("{}", fmt::join(names.begin(), end, ", "));
  return names.size() <= kNamed ? named : fmt::format("{} and {} more", named, names.size() - kNamed);
}

}  // namespace weft
