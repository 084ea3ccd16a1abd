#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "weft/chunks/TextureChunk.h"
#include "weft/core/Result.h"

namespace weft {

/// An OpenEXR file as a rectangle texture of floats, addressed in texels: file -> FloatImage ->
/// TextureChunk, as [Meseth 2004] 5.4 keeps a material's parameters.
///
/// `channels`: 1 to 4 names in the order in which they become r, g, b, a; the file may have more.
/// Half stays half, float stays float. Fails, with file and reason, on a file that is not OpenEXR,
/// or lacks a channel. Touches no GL.
Result<std::shared_ptr<TextureChunk>> loadRectangleTexture(const std::filesystem::path& path,
                                                           const std::vector<std::string>& channels = {
                                                               "R", "G", "B"});

}  // namespace weft
