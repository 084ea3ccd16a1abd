#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

/// Writes a baked BTF as a zip in UBO2003's layout, so that it reads like a measured one: JPEGs of
/// quality 95 without chroma subsampling, gamma 2.2 encoded, clamped to 0..1, with the angles in
/// their names.
///
/// `readView` is called once a view, in order, and fills linear RGB `out[light][row][column][rgb]`;
/// one view is held at a time. `description.name` names the material; its encoding must be Gamma22
/// and its cosine flag true, because the layout can say nothing else. Written beside its place and
/// renamed; fails with what `readView` fails with, or when the disk does. Equal input gives equal
/// bytes.
Result<void> writeBtfZip(const std::filesystem::path& path, const BtfDescription& description,
                         const std::function<Result<void>(int view, std::span<float> out)>& readView);

}  // namespace weft
