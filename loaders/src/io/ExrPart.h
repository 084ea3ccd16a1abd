#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/io/WithinMemory.h"

namespace weft {

/// What a part of an OpenEXR file holds, checked: a flat image of half or float channels.
struct ExrPartShape {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;      ///< alphabetical
  Precision precision = Precision::Half;  ///< Half where all channels are
};

/// Walks the attributes of all headers and fails where a size exceeds the file, since OpenEXR takes
/// memory for an attribute before it reads it, and where headers are out of all proportion to the
/// file. Returns the file's size in bytes.
Result<std::uint64_t> checkExrFile(const std::filesystem::path& path);

/// Columns and rows. Fails on deep parts, and on more than 16384 pixels a side.
Result<glm::ivec2> exrPartSize(const Imf::Header& header, const std::string& where);

/// Fails like exrPartSize(), and on integer and subsampled channels.
Result<ExrPartShape> exrPartShape(const Imf::Header& header, const std::string& where);

/// Fails where `values` floats are out of all proportion to the size of the file that claims to
/// hold them.
Result<void> checkExrMemory(std::uint64_t values, std::uint64_t fileBytes, const std::string& where);

/// Fails where opening a part, for which OpenEXR takes the memory of some rows with all their
/// channels, is out of proportion to the file.
Result<void> checkExrPart(const Imf::Header& header, std::uint64_t fileBytes, const std::string& where);

/// For an image of `values` floats that is much larger than its file: unpacks these channels of the
/// part once into the memory of a single row, so that pixels that are not there are known before
/// memory is taken. Throws what OpenEXR throws.
void proveExrPart(Imf::InputPart& part, const std::vector<std::string>& channels, std::uint64_t values,
                  std::uint64_t fileBytes);

/// What `read` returns; a failure with what OpenEXR throws in it, or that memory ran out.
template <class Read>
auto readingExr(const std::string& where, const Read& read) -> decltype(read()) {
  try {
    return withinMemory(where, read);
  } catch (const std::exception& error) {
    return fail(std::string("the OpenEXR file is damaged: ") + error.what(), where);
  }
}

/// The header of a part that holds one layer of `image`, compressed by ZIP.
Imf::Header exrPartHeader(const FloatImage& image);

/// Reads every channel of `image` into one of its layers. Throws what OpenEXR throws.
void readExrPart(Imf::InputPart& part, FloatImage& image, int layer);
/// The same of channels that have other names in the file, in the order of the image's.
void readExrPart(Imf::InputPart& part, FloatImage& image, int layer, const std::vector<std::string>& names);

/// Writes one layer as a file of one part. Throws what OpenEXR throws.
void writeExrPart(Imf::OutputFile& file, const FloatImage& image, int layer);

}  // namespace weft
