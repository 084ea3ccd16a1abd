#include "weft/synthesis/SynthesisQuality.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "Fourier.h"
#include "SourceRegion.h"
#include "weft/core/Contract.h"

namespace weft {
namespace {

// --- Seams ---

/// Distances in one level of a sample.
class SampleLevel {
 public:
  SampleLevel(const AppearanceSample& sample, int side)
      : vectors_(side == 1 ? sample.vectors : blurred(sample.vectors, side, sample.repeats)),
        side_(side),
        repeats_(sample.repeats) {}

  /// Of b and what follows a; of b and a where nothing follows.
  double across(glm::ivec2 a, glm::ivec2 b, glm::ivec2 step) const {
    const glm::ivec2 next = followed(a, step);
    return isInside(next) ? distance(next, b) : distance(a, b);
  }
  /// Of a and its neighbour on this level.
  double along(glm::ivec2 a, glm::ivec2 step) const {
    glm::ivec2 next = followed(a, step * side_);
    if (!isInside(next)) next = a - step * side_;
    return isInside(next) ? distance(a, next) : 0.0;
  }
  bool continues(glm::ivec2 a, glm::ivec2 b, glm::ivec2 step) const { return followed(a, step) == b; }

 private:
  glm::ivec2 followed(glm::ivec2 a, glm::ivec2 step) const {
    const glm::ivec2 next = a + step;
    return repeats_ ? glm::ivec2(next.x % vectors_.width, next.y % vectors_.height) : next;
  }
  bool isInside(glm::ivec2 a) const {
    return a.x >= 0 && a.y >= 0 && a.x < vectors_.width && a.y < vectors_.height;
  }
  double distance(glm::ivec2 a, glm::ivec2 b) const { return double{vectors_.distance(a.x, a.y, b.x, b.y)}; }

  AppearanceVectors vectors_;
  int side_;
  bool repeats_;
};

struct SeamSums {
  double across = 0.0, along = 0.0, jumps = 0.0;
};

SeamSums seamsOn(const SampleLevel& level, const CoordinateMap& map) {
  SeamSums sums;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        const glm::ivec2 a = map.at(x, y),
                         b = map.at((x + step.x) % map.width(), (y + step.y) % map.height());
        if (level.continues(a, b, step)) continue;
        sums.across += level.across(a, b, step);
        sums.along += level.along(a, step);
        sums.jumps += 1.0;
      }
  return sums;
}

// --- Repetition ---

constexpr int kCorrelatedDimensions = 8;

/// The correlation at each shift, of what `texelAt` shows: means over texels that overlap there.
template <class TexelAt>
Eigen::MatrixXd correlationAt(const AppearanceVectors& vectors, glm::ivec2 size, glm::ivec2 padded,
                              const TexelAt& texelAt) {
  Eigen::MatrixXd power = Eigen::MatrixXd::Zero(padded.y, padded.x);
  Eigen::MatrixXd plane = power;
  for (int d = 0; d < std::min(kCorrelatedDimensions, vectors.dimensions); ++d) {
    plane.setZero();
    auto filled = plane.topLeftCorner(size.y, size.x);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const glm::ivec2 texel = texelAt(x, y);
        filled(y, x) = double{vectors.at(texel.x, texel.y)[d]};
      }
    filled.array() -= filled.mean();
    power += fourier(plane).cwiseAbs2();
  }
  plane.setZero();
  plane.topLeftCorner(size.y, size.x).setOnes();
  // Means over as many texels as there are at each shift.
  const Eigen::MatrixXd counts = correlationOf(fourier(plane).cwiseAbs2()).cwiseMax(1.0);
  const Eigen::MatrixXd result = correlationOf(power).cwiseQuotient(counts);
  return result(0, 0) > 0.0 ? Eigen::MatrixXd(result / result(0, 0)) : result;
}

/// A shift round a torus as it is seen from its middle.
glm::ivec2 shortestShift(int x, int y, glm::ivec2 size) {
  return {x > size.x / 2 ? x - size.x : x, y > size.y / 2 ? y - size.y : y};
}

double lengthOf(glm::ivec2 shift) {
  return std::hypot(shift.x, shift.y);
}

double correlationOfSample(const AppearanceSample& sample, double nearest) {
  const SourceRegion region = sourcesOf(sample);
  const glm::ivec2 size(region.width, region.height), padded = sample.repeats ? size : 2 * size;
  const Eigen::MatrixXd all = correlationAt(
      sample.vectors, size, padded, [&](int x, int y) { return glm::ivec2(region.x + x, region.y + y); });
  double most = 0.0;
  for (int y = 0; y < padded.y; ++y)
    for (int x = 0; x < padded.x; ++x) {
      const glm::ivec2 shift = shortestShift(x, y, padded);
      const bool isKnown = std::abs(shift.x) <= size.x / 2 && std::abs(shift.y) <= size.y / 2;
      if (isKnown && lengthOf(shift) >= nearest) most = std::max(most, all(y, x));
    }
  return most;
}

/// How many texels show what another one shows, at each shift: of as many texels of the sample as
/// do not take long, which lie evenly.
double copiedShare(const CoordinateMap& map, double nearest) {
  std::vector<std::vector<glm::ivec2>> uses(static_cast<std::size_t>(map.sampleWidth() * map.sampleHeight()));
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const glm::ivec2 texel = map.at(x, y);
      uses[static_cast<std::size_t>(texel.y * map.sampleWidth() + texel.x)].emplace_back(x, y);
    }
  std::erase_if(uses, [](const auto& places) { return places.empty(); });
  double pairs = 0.0;
  for (const auto& places : uses) pairs += static_cast<double>(places.size() * places.size());
  const auto step = static_cast<std::size_t>(std::max(1.0, pairs / 2e7));
  const glm::ivec2 size(map.width(), map.height());
  std::vector<std::uint32_t> counts(map.texels().size());
  double texels = 0.0;
  for (std::size_t i = 0; i < uses.size(); i += step) {
    texels += static_cast<double>(uses[i].size());
    for (const glm::ivec2 a : uses[i])
      for (const glm::ivec2 b : uses[i]) {
        const glm::ivec2 shift((b.x - a.x + size.x) % size.x, (b.y - a.y + size.y) % size.y);
        ++counts[static_cast<std::size_t>(shift.y * size.x + shift.x)];
      }
  }
  std::uint32_t most = 0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      if (lengthOf(shortestShift(x, y, size)) >= nearest)
        most = std::max(most, counts[static_cast<std::size_t>(y * size.x + x)]);
  return texels > 0.0 ? most / texels : 0.0;
}

}  // namespace

SeamVisibility seamVisibility(const AppearanceSample& sample, const CoordinateMap& map) {
  WEFT_EXPECT(map.sampleWidth() == sample.vectors.width && map.sampleHeight() == sample.vectors.height,
              "the map is of this sample");
  SeamVisibility result;
  for (std::size_t i = 0; i < SeamVisibility::kSides.size(); ++i) {
    const SeamSums sums = seamsOn(SampleLevel(sample, SeamVisibility::kSides[i]), map);
    if (sums.along > 0.0) result.mean[i] = sums.across / sums.along;
    result.jumps = sums.jumps / (2.0 * static_cast<double>(map.texels().size()));
  }
  return result;
}

double Repetition::beyondSample() const {
  return ofSample < 1.0 ? std::max(0.0, (correlation - ofSample) / (1.0 - ofSample)) : 0.0;
}

Repetition repetition(const AppearanceSample& sample, const CoordinateMap& map) {
  const double nearest = 0.25 * std::min(map.sampleWidth(), map.sampleHeight());
  const glm::ivec2 size(map.width(), map.height());
  const Eigen::MatrixXd all =
      correlationAt(sample.vectors, size, size, [&](int x, int y) { return map.at(x, y); });
  Repetition result;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      if (lengthOf(shortestShift(x, y, size)) >= nearest)
        result.correlation = std::max(result.correlation, all(y, x));
  result.ofSample = correlationOfSample(sample, nearest);
  result.copied = copiedShare(map, nearest);
  return result;
}

Result<CoordinateMap> tiledMap(int width, int height, const AppearanceSample& sample) {
  std::vector<glm::u16vec2> texels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) texels.emplace_back(x % sample.vectors.width, y % sample.vectors.height);
  return CoordinateMap::create(width, height, sample.vectors.width, sample.vectors.height, std::move(texels),
                               sample.name);
}

}  // namespace weft
