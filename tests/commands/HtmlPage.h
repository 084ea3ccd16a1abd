#pragma once

#include <filesystem>
#include <string>

#include "TextFile.h"

namespace weft::test {

/// A page without the bytes of its pictures, in which any word may occur.
inline std::string pageWithoutPictures(const std::filesystem::path& file) {
  std::string text = readText(file);
  const std::string start = ";base64,";
  for (std::size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + start.size()))
    text.erase(at + start.size(), text.find('"', at) - at - start.size());
  return text;
}

}  // namespace weft::test
