#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// What a part of an OpenEXR file holds, checked: a flat image of half or float channels.
struct ExrPartShape {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;      ///< alphabetical
  Precision precision = Precision::Half;  ///< Half where all channels are
};

/// Walks the attributes of all headers and fails where a size exceeds the file, since OpenEXR takes memory
/// for an attribute before it reads it. Returns the file's size in bytes.
Result<std::uint64_t> checkExrFile(const std::filesystem::path& path);

/// Fails on deep, integer and subsampled parts, and on more than 16384 pixels a side.
Result<ExrPartShape> exrPartShape(const Imf::Header& header, const std::string& where);

/// Fails where `values` floats are out of all proportion to the size of the file that claims to hold them.
Result<void> checkExrMemory(std::uint64_t values, std::uint64_t fileBytes, const std::string& where);

/// The header of a part that holds one layer of `image`, compressed by ZIP.
Imf::Header exrPartHeader(const FloatImage& image);

/// Reads every channel of `image` into one of its layers. Throws what OpenEXR throws.
void readExrPart(Imf::InputPart& part, FloatImage& image, int layer);

/// Writes one layer as a file of one part. Throws what OpenEXR throws.
void writeExrPart(Imf::OutputFile& file, const FloatImage& image, int layer);

}  // namespace weft
