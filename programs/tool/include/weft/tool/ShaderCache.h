#pragma once

#include <cstdint>
#include <filesystem>

namespace weft {

/// For the start of a program that draws, before any thread: tells Mesa to keep no cache of shaders
/// where its disk is nearly full. Mesa maps the cache's index into memory, and a disk that fills up
/// then ends the process. Elsewhere the cache stays, which halves the start.
void avoidShaderCacheOnFullDisk();

/// Where Mesa keeps its cache; empty where it has no place.
std::filesystem::path shaderCacheFolder();

/// Whether the disk of a folder, which need not be there yet, has fewer free bytes than these.
bool hasLessSpace(const std::filesystem::path& folder, std::uint64_t bytes);

}  // namespace weft
