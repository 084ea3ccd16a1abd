#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

namespace weft::test {

inline void writeText(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace weft::test
