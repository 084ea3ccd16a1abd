#include "BorderTexels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "weft/core/Direction.h"

namespace weft {
namespace {

/// The mean distance of the columns x and x + 1, or of the rows.
double meanStep(const AppearanceVectors& v, int at, bool columns) {
  const int count = columns ? v.height : v.width, size = columns ? v.width : v.height;
  double sum = 0.0;
  for (int i = 0; i < count; ++i)
    sum += columns ? v.distance(at, i, (at + 1) % size, i) : v.distance(i, at, i, (at + 1) % size);
  return sum / count;
}

/// Nothing sets the border apart from what is within.
bool borderContinues(const AppearanceVectors& v, bool columns) {
  const int size = columns ? v.width : v.height;
  double most = 0.0;
  for (int at = 0; at + 1 < size; ++at) most = std::max(most, meanStep(v, at, columns));
  return meanStep(v, size - 1, columns) <= most;
}

}  // namespace

std::vector<int> viewsWithin(const std::vector<glm::vec3>& views, const PolarRange& range) {
  std::vector<int> chosen;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double polar = degreesFromDirection(views[i]).x;
    if (polar >= double{range.lowest} - 0.01 && polar <= double{range.highest} + 0.01)
      chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

bool repeats(const AppearanceVectors& vectors) {
  return borderContinues(vectors, true) && borderContinues(vectors, false);
}

float largestShift(const Registration& registration, const std::vector<glm::vec3>& views) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < views.size() && i < registration.deviations.size(); ++i) {
    const glm::vec2 shift = registration.height * reliefTangent(views[i]) + registration.deviations[i];
    largest = std::max({largest, std::abs(shift.x), std::abs(shift.y)});
  }
  return largest;
}

void keepFromBorder(AppearanceSample& sample, float shift) {
  const AppearanceVectors& v = sample.vectors;
  const int wanted = static_cast<int>(std::ceil(shift));
  sample.margin = std::min(wanted, std::min(v.width, v.height) / 5);
  if (sample.margin < wanted)
    sample.warnings.push_back(fmt::format(
        "the relief moves texels by up to {}, of {} x {}: sources between {} and {} texels from the border "
        "show at low views what lies at the opposite one; take a larger sample",
        wanted, v.width, v.height, sample.margin, wanted));
}

}  // namespace weft
