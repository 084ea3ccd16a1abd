#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "SourceRegion.h"
#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// What is regular in a sample: up to two waves, in cycles a texel, x along columns, y down the
/// rows. None of felt, one of ribs, two of a weave.
struct Lattice {
  std::vector<glm::dvec2> waves;
};

/// The strongest peaks of the power spectrum of the sources, if they hold enough of its power and
/// have at least two periods there.
Lattice findLattice(const AppearanceVectors& vectors, const SourceRegion& region);

/// Whether a shift is about a whole number of periods of every wave, up to `tolerance` of one.
bool isInPhase(const Lattice& lattice, glm::dvec2 shift, double tolerance);

/// A lattice as it has to be stretched so that `width` x `height` texels hold whole periods.
Lattice fitted(const Lattice& lattice, int width, int height);

}  // namespace weft
