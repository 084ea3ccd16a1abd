#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/reflectance/CoordinateMap.h"
#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// How a surface is put together from a sample.
enum class SynthesisMethod {
  Patches,     ///< patches that are cut along where they agree; keeps what is regular
  KCoherence,  ///< texel by texel ([Bosserhoff 2003], section 4.2)
  JumpMap,     ///< likewise, by a random choice of what continues: fast
};

struct SynthesisOptions {
  SynthesisMethod method = SynthesisMethod::Patches;
  int width = 0;
  int height = 0;
  std::uint64_t seed = 1;
  int k = 6;             ///< k-coherence: candidates that each neighbour brings, 1..10
  int neighborhood = 2;  ///< the paper's methods: texels on each side, 1..3
  int layers = 3;        ///< k-coherence: of the pyramid, from fine to coarse, 1..8
  int textons = 1000;    ///< centres of the clusters that stand for texels; the paper's methods
};

/// "patches", "k-coherence", "jump-map".
std::string_view name(SynthesisMethod method);

struct Synthesis {
  CoordinateMap map;
  double analysisSeconds = 0.0;   ///< of the sample, for any number of maps
  double synthesisSeconds = 0.0;  ///< on one thread
  std::vector<std::string> warnings;
};

/// Makes a coordinate map of `width` x `height` texels that look like the sample. The map repeats,
/// but for a jump map: opposite borders continue each other. Equal input gives an equal map, for
/// any number of threads. Fails on options out of range, on sizes below 8 texels, and on a sample
/// with too few sources.
Result<Synthesis> synthesize(const AppearanceSample& sample, const SynthesisOptions& options,
                             const Progress& progress = {});

}  // namespace weft
