#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "weft/measurement/BtfSource.h"

namespace weft {

/// A BTF of one view, from the top: photographs under one light each, as RTI and PTM tools take them, listed
/// by a `.lp` text file. Its first line counts the lights; each other line holds the file of an image and
/// the vector to its light (x right, y up, z to the camera; of any length). Values are taken as sRGB, as
/// cameras write JPEGs.
///
/// Lists are often written on another machine: an image that is not where its line says is looked for beside
/// the list by its last name; where none is found, the images beside the list are taken in order of their
/// names. Lights on or below the horizon stay, and so does the same light twice, as RealRTI's item 11 has it.
/// Fails, naming the line, on anything else, on the same image twice, and on more than 1000 lights.
Result<std::unique_ptr<BtfSource>> openLightList(const std::filesystem::path& path, std::string name);

}  // namespace weft
