#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "FileCollection.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

/// Whether the name is that of a light list: `.lp`.
bool isLightList(std::string_view path);

/// The light list among files, as an index: of those in as few folders as any the only one; nothing
/// where there is none. Fails, naming both, on two. `where` names the collection.
Result<std::optional<int>> findLightList(const FileCollection& files, const std::string& where);

/// A BTF of one view, from the top: photographs under one light each, as RTI and PTM tools take
/// them, listed by a `.lp` text file. Its first line counts the lights; each other line holds the
/// file of an image and the vector to its light (x right, y up, z to the camera; of any length).
/// Values are taken as sRGB, as cameras write JPEGs.
///
/// Lists are often written on another machine: an image that is not where its line says is looked
/// for (ImageFinder.h) in the list's folder, in those of its lines beside and above it, and where
/// RTIBuilder exports images. None is taken by order, unless `options` ask for it. Lights on or
/// below the horizon are left out with a warning, a count that is one off has one; the same light
/// twice stays, as RealRTI's item 11 has it. Fails, naming the line, on anything else, on the same
/// image twice, and on more than 1000 lights.
Result<std::unique_ptr<BtfSource>> openLightList(const std::filesystem::path& path, std::string name,
                                                 const BtfOptions& options);

/// The same of a list among files: in a zip. `where` names the zip.
Result<std::unique_ptr<BtfSource>> openLightList(std::unique_ptr<FileCollection> files, int list,
                                                 std::string where, std::string name,
                                                 const BtfOptions& options);

}  // namespace weft
