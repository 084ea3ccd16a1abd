#include "solvers/GlossLevels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "solvers/LaplacianPyramid.h"
#include "weft/reflectance/GlossLobe.h"

namespace weft {
namespace {

constexpr std::size_t kFirst = 3;  // of the lobe's numbers

// What adds up: the amount, and times that the slope and the mean square of a facet's slope.
NumberImage glossSums(const FloatImage& shared) {
  NumberImage sums{shared.width(), shared.height(), 4, {}};
  for (int y = 0; y < shared.height(); ++y)
    for (int x = 0; x < shared.width(); ++x) {
      const GlossLobe lobe = GlossLobe::from(shared.texel(x, y).subspan(kFirst));
      const glm::vec3 n = lobe.normal();
      const glm::vec2 slope = glm::vec2(n) / n.z;
      const float square = glm::dot(slope, slope) + lobe.alpha * lobe.alpha;
      for (const float number : {1.0f, slope.x, slope.y, square}) sums.values.push_back(lobe.amount * number);
    }
  return sums;
}

GlossLobe lobeOf(const float* sums) {
  const float amount = sums[0];
  if (!(amount > 0.0f)) return {};
  const glm::vec2 slope = glm::vec2(sums[1], sums[2]) / amount;
  const float square = glm::dot(slope, slope), spread = std::max(sums[3] / amount - square, 0.0f);
  return {slope / (1.0f + std::sqrt(1.0f + square)), std::min(std::sqrt(spread), 1.0f), amount};
}

FloatImage withoutGloss(const FloatImage& shared) {
  std::vector<std::string> channels = shared.channels();
  const auto first = channels.begin() + kFirst;
  channels.erase(first, first + GlossLobe::kNumbers);
  FloatImage rest(shared.width(), shared.height(), channels);
  for (int y = 0; y < shared.height(); ++y)
    for (int x = 0; x < shared.width(); ++x) {
      const std::span<const float> from = shared.texel(x, y);
      const auto colorEnd = std::ranges::copy(from.first(kFirst), rest.texel(x, y).begin()).out;
      std::ranges::copy(from.subspan(kFirst + GlossLobe::kNumbers), colorEnd);
    }
  rest.setPrecision(shared.precision());
  return rest;
}

FloatImage withGloss(const FloatImage& rest, const NumberImage& sums,
                     const std::vector<std::string>& channels) {
  FloatImage shared(rest.width(), rest.height(), channels);
  for (int y = 0; y < rest.height(); ++y)
    for (int x = 0; x < rest.width(); ++x) {
      const std::span<const float> from = rest.texel(x, y);
      auto to = std::ranges::copy(from.first(kFirst), shared.texel(x, y).begin()).out;
      to = std::ranges::copy(lobeOf(sums.at(x, y)).rounded().numbers(), to).out;
      std::ranges::copy(from.subspan(kFirst), to);
    }
  if (rest.precision() == Precision::Half) shared.roundToHalf();
  return shared;
}

}  // namespace

std::vector<FieldLevel> glossLevels(
    const FieldLevel& finest, const std::function<std::vector<FieldLevel>(FieldLevel)>& levelsOfOthers) {
  std::vector<FieldLevel> levels = levelsOfOthers({withoutGloss(finest.shared), {}});
  NumberImage sums = glossSums(finest.shared);
  levels.front() = finest;
  for (std::size_t level = 1; level < levels.size(); ++level) {
    sums = halved(sums);
    levels[level].shared = withGloss(levels[level].shared, sums, finest.shared.channels());
  }
  return levels;
}

}  // namespace weft
