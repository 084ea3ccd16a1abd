#include "solvers/LoomLevels.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "solvers/LaplacianPyramid.h"

namespace weft {
namespace {

// Of texels on the way to coarser levels: weights, then red, green, blue times weights.
NumberImage sumsOf(const FloatImage& shared) {
  const std::size_t components = static_cast<std::size_t>(shared.channelCount()) - 3;
  NumberImage sums{shared.width(), shared.height(), 4 * components, {}};
  sums.values.reserve(shared.values().size() * 4);
  for (int y = 0; y < shared.height(); ++y)
    for (int x = 0; x < shared.width(); ++x) {
      const std::span<const float> texel = shared.texel(x, y);
      for (const float factor : {1.0f, texel[0], texel[1], texel[2]})
        for (std::size_t k = 0; k < components; ++k) sums.values.push_back(factor * texel[3 + k]);
    }
  return sums;
}

// How many components a coarse level has: what the others hold averages out over its texels.
std::size_t componentsOf(std::size_t level, std::size_t components) {
  constexpr std::size_t kOfLevel2 = 32, kFewest = 8;
  if (level < 2) return components;
  return std::min(components, std::max(kOfLevel2 >> std::min<std::size_t>(level - 2, 8), kFewest));
}

// The base colour with which the first `kept` weights come closest to what all weights give of red,
// green and blue.
glm::vec3 colorOf(const float* sums, std::span<const double> gram, std::size_t components, std::size_t kept) {
  // `numbers` of some weights times the products of terms times the weights that are kept
  const auto product = [&](const float* numbers, std::size_t count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < kept; ++k)
        sum += double{numbers[i]} * gram[i * components + k] * double{sums[k]};
    return sum;
  };
  const double squares = product(sums, kept);
  if (!(squares > 0.0)) return glm::vec3(1.0f);
  glm::vec3 color;
  for (int c = 0; c < 3; ++c)
    color[c] = static_cast<float>(product(sums + static_cast<std::size_t>(c + 1) * components, components) /
                                  squares);
  return color;
}

}  // namespace

std::vector<double> weightedGram(std::span<const float> terms, std::size_t components,
                                 std::span<const float> squaredWeights) {
  const std::size_t pairs = terms.size() / components;
  std::vector<double> ofPair(pairs);
  for (std::size_t i = 0; i < squaredWeights.size(); ++i) ofPair[i % pairs] += double{squaredWeights[i]};
  std::vector<double> gram(components * components);
  tbb::parallel_for(std::size_t{0}, components, [&](std::size_t i) {
    for (std::size_t pair = 0; pair < pairs; ++pair)
      for (std::size_t k = 0; k < components; ++k)
        gram[i * components + k] +=
            ofPair[pair] * double{terms[pair * components + i]} * double{terms[pair * components + k]};
  });
  return gram;
}

std::vector<FieldLevel> loomLevels(FieldLevel finest, std::span<const double> gram,
                                   const std::function<float(float)>& roundWeight,
                                   const std::function<glm::vec3(glm::vec3)>& roundColor) {
  const std::vector<std::string> channels = finest.shared.channels();
  const Precision precision = finest.shared.precision();
  const std::size_t components = channels.size() - 3;
  NumberImage sums = sumsOf(finest.shared);
  std::vector<FieldLevel> levels;
  levels.push_back(std::move(finest));
  while (sums.width > 1 || sums.height > 1) {
    sums = halved(sums);
    const std::size_t kept = componentsOf(levels.size(), components);
    FloatImage shared(sums.width, sums.height, channels);
    tbb::parallel_for(0, sums.height, [&](int y) {
      for (int x = 0; x < sums.width; ++x) {
        const std::span<float> texel = shared.texel(x, y);
        const float* from = sums.at(x, y);
        const glm::vec3 color = roundColor(colorOf(from, gram, components, kept));
        for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] = color[c];
        for (std::size_t k = 0; k < kept; ++k) texel[3 + k] = roundWeight(from[k]);
      }
    });
    if (precision == Precision::Half) shared.roundToHalf();
    levels.push_back({std::move(shared), {}});
  }
  return levels;
}

}  // namespace weft
