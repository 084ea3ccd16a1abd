#include "weft/synthesis/Synthesis.h"

#include <fmt/format.h>

#include <chrono>
#include <glm/geometric.hpp>

#include "CoherenceSynthesis.h"
#include "PatchSynthesis.h"

namespace weft {
namespace {

/// Sources of so few texels a side say too little.
constexpr int kFewestSources = 12;
constexpr int kFewestTexels = 8;
/// The parts of patches continue each other less well where the sample is stretched further.
constexpr double kStretch = 0.04;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Result<void> checkOptions(const AppearanceSample& sample, const SynthesisOptions& options) {
  const auto isWithin = [](int value, int least, int most) { return value >= least && value <= most; };
  const auto outside = [&](const char* what, int value, int least, int most) {
    return fail(fmt::format("{} is {}", what, value), sample.name, fmt::format("{} to {}", least, most));
  };
  for (const int side : {options.width, options.height})
    if (!isWithin(side, kFewestTexels, CoordinateMap::kLargestSide))
      return outside("a side of the surface", side, kFewestTexels, CoordinateMap::kLargestSide);
  if (!isWithin(options.k, 1, kSimilarTexels)) return outside("k", options.k, 1, kSimilarTexels);
  if (!isWithin(options.neighborhood, 1, 3)) return outside("the neighborhood", options.neighborhood, 1, 3);
  if (!isWithin(options.layers, 1, 8)) return outside("the number of layers", options.layers, 1, 8);
  if (!isWithin(options.textons, 1, 65535))
    return outside("the number of textons", options.textons, 1, 65535);
  const SourceRegion sources = sourcesOf(sample);
  if (std::min(sources.width, sources.height) < kFewestSources)
    return fail(
        fmt::format("the sample has {} x {} sources, which are too few", sources.width, sources.height),
        sample.name, fmt::format("{} a side at least", kFewestSources));
  return {};
}

void warnOfStretching(const Lattice& lattice, int width, int height, std::vector<std::string>& warnings) {
  const Lattice stretched = fitted(lattice, width, height);
  for (std::size_t i = 0; i < lattice.waves.size(); ++i) {
    const double length = glm::length(lattice.waves[i]);
    const double stretch = glm::length(stretched.waves[i] - lattice.waves[i]) / length;
    if (stretch > kStretch)
      warnings.push_back(
          fmt::format("the sample repeats itself every {:.1f} texels, which {} x {} are no multiple of: what "
                      "is regular is "
                      "deformed by {:.0f} %, and seams show more",
                      1.0 / length, width, height, 100.0 * stretch));
  }
}

/// Of the sources alone.
AppearanceVectors finestLayer(const AppearanceSample& sample) {
  const SourceRegion region = sourcesOf(sample);
  AppearanceVectors layer{region.width, region.height, sample.vectors.dimensions, {}};
  for (int y = 0; y < region.height; ++y) {
    const float* row = sample.vectors.at(region.x, region.y + y);
    layer.values.insert(layer.values.end(), row, row + region.width * layer.dimensions);
  }
  return layer;
}

AppearanceVectors halved(const AppearanceVectors& fine) {
  AppearanceVectors coarse{fine.width / 2, fine.height / 2, fine.dimensions, {}};
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x)
      for (int d = 0; d < coarse.dimensions; ++d)
        coarse.values.push_back(0.25f * (fine.at(2 * x, 2 * y)[d] + fine.at(2 * x + 1, 2 * y)[d] +
                                         fine.at(2 * x, 2 * y + 1)[d] + fine.at(2 * x + 1, 2 * y + 1)[d]));
  return coarse;
}

std::vector<AnalysedLayer> analysedLayers(const AppearanceSample& sample, const SynthesisOptions& options,
                                          const Progress& progress, std::vector<std::string>& warnings) {
  AppearanceVectors vectors = finestLayer(sample);
  std::vector<AnalysedLayer> layers;
  const int wanted = options.method == SynthesisMethod::JumpMap ? 1 : options.layers;
  while (static_cast<int>(layers.size()) < wanted) {
    if (std::min(vectors.width, vectors.height) < 2 * options.neighborhood + 2) {
      warnings.push_back(fmt::format("the sample is too small for more than {} layers", layers.size()));
      break;
    }
    layers.push_back(analyseLayer(vectors, options.neighborhood, options.textons));
    vectors = halved(vectors);
    if (progress) progress(static_cast<double>(layers.size()) / wanted);
  }
  if (layers.front().textons.count < options.textons)
    warnings.push_back(fmt::format("there are {} different texels, and as many textons, not {}",
                                   layers.front().textons.count, options.textons));
  return layers;
}

/// Texels of the sample, and how long it took.
struct MadeSurface {
  std::vector<glm::ivec2> texels;
  double analysisSeconds = 0.0, synthesisSeconds = 0.0;
};

MadeSurface fromPatches(const AppearanceSample& sample, const SynthesisOptions& options,
                        const Progress& progress, std::vector<std::string>& warnings) {
  const Stopwatch analysis;
  const PatchSize patches = patchSizeFor(sourcesOf(sample), options.width, options.height);
  const PatchSource source(sample, patches.reach());
  warnOfStretching(source.lattice(), options.width, options.height, warnings);
  MadeSurface surface{{}, analysis.seconds(), 0.0};
  const Stopwatch synthesis;
  surface.texels = synthesizePatches(source, patches, options.width, options.height, options.seed, progress);
  surface.synthesisSeconds = synthesis.seconds();
  return surface;
}

MadeSurface texelByTexel(const AppearanceSample& sample, const SynthesisOptions& options,
                         const Progress& progress, std::vector<std::string>& warnings) {
  const Stopwatch analysis;
  const std::vector<AnalysedLayer> layers = analysedLayers(sample, options, progress, warnings);
  MadeSurface surface{{}, analysis.seconds(), 0.0};
  const Stopwatch synthesis;
  surface.texels = options.method == SynthesisMethod::JumpMap
                       ? synthesizeByJumps(layers.front(), options.width, options.height, options.seed)
                       : synthesizeCoherently(layers, options.width, options.height, options.k, options.seed);
  surface.synthesisSeconds = synthesis.seconds();
  const SourceRegion region = sourcesOf(sample);
  for (glm::ivec2& texel : surface.texels) texel += glm::ivec2(region.x, region.y);
  return surface;
}

}  // namespace

std::string_view name(SynthesisMethod method) {
  constexpr std::string_view kNames[] = {"patches", "k-coherence", "jump-map"};
  return kNames[static_cast<int>(method)];
}

Result<Synthesis> synthesize(const AppearanceSample& sample, const SynthesisOptions& options,
                             const Progress& progress) {
  WEFT_TRY_VOID(checkOptions(sample, options));
  std::vector<std::string> warnings = sample.warnings;
  MadeSurface surface = options.method == SynthesisMethod::Patches
                            ? fromPatches(sample, options, progress, warnings)
                            : texelByTexel(sample, options, progress, warnings);
  WEFT_TRY(CoordinateMap map,
           CoordinateMap::create(options.width, options.height, sample.vectors.width, sample.vectors.height,
                                 {surface.texels.begin(), surface.texels.end()}, sample.name));
  return Synthesis{std::move(map), surface.analysisSeconds, surface.synthesisSeconds, std::move(warnings)};
}

}  // namespace weft
