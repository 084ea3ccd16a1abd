#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "PatchSource.h"
#include "weft/core/Progress.h"

namespace weft {

/// The sides of patches, in texels.
struct PatchSize {
  int step = 0;     ///< from one patch to the next, about
  int overlap = 0;  ///< even

  int reach() const { return step + 1 + overlap; }
};

/// About two fifths of the sources' side.
PatchSize patchSizeFor(const SourceRegion& sources, int width, int height);

/// Covers a torus of `width` x `height` texels with patches of the sample, row after row: each
/// continues those around it best among many that show the same phase of what is regular, and is
/// cut along where they agree (Efros and Freeman 2001; the lattice is ours). Returns a texel of the
/// sample for each texel.
std::vector<glm::ivec2> synthesizePatches(const PatchSource& source, const PatchSize& patches, int width,
                                          int height, std::uint64_t seed, const Progress& progress);

}  // namespace weft
