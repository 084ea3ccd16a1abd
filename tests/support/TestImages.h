#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "weft/core/Image.h"

namespace weft::test {

using Bytes = std::vector<std::uint8_t>;

Bytes bytesOf(const std::filesystem::path& file);
void writeBytes(const std::filesystem::path& file, const Bytes& bytes);

/// An RGB image whose bytes are `value(x, y, channel)`.
Image imageOf(int width, int height, const std::function<int(int, int, int)>& value);

/// A PNG of 16 bits a channel, RGB, whose values are `value(x, y, channel)`.
Bytes widePng(int width, int height, const std::function<int(int, int, int)>& value);

/// Packs a folder, its files in order of name, by an independent hand: libzip itself.
void zipFolder(const std::filesystem::path& folder, const std::filesystem::path& zip, bool deflate);

/// The names of everything in a folder, hidden files included, sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

}  // namespace weft::test
