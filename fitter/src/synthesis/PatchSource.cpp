#include "PatchSource.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <random>
#include <utility>

namespace weft {
namespace {

/// The first `count` dimensions of vectors, 0 where there are fewer, repeated up to a size.
AppearanceVectors repeated(const AppearanceVectors& vectors, int count, glm::ivec2 size) {
  AppearanceVectors result{size.x, size.y, count, {}};
  result.values.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                       static_cast<std::size_t>(count));
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      std::copy_n(vectors.at(x % vectors.width, y % vectors.height), std::min(count, vectors.dimensions),
                  result.at(x, y));
  return result;
}

/// Vectors side by side.
AppearanceVectors sideBySide(const AppearanceVectors& a, const AppearanceVectors& b) {
  AppearanceVectors result = repeated(a, a.dimensions + b.dimensions, {a.width, a.height});
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) std::copy_n(b.at(x, y), b.dimensions, result.at(x, y) + a.dimensions);
  return result;
}

constexpr int kFine = 24, kCoarse = 16;
/// How many texels at random are looked at for similar ones, and how far their phases may be off.
constexpr int kLookedAt = 512;
constexpr double kSimilarPhase = 0.06;
constexpr float kCoarseWeight = 0.3f;

}  // namespace

PatchSource::PatchSource(const AppearanceSample& sample, int reach)
    : region_(sourcesOf(sample)),
      sampleSize_(sample.vectors.width, sample.vectors.height),
      repeats_(sample.repeats),
      lattice_(findLattice(sample.vectors, region_)) {
  const AppearanceVectors& vectors = sample.vectors;
  const glm::ivec2 size = sampleSize_ + (repeats_ ? reach : 0);
  if (repeats_) region_.width += reach, region_.height += reach;
  const auto first = [&](int side, int count) {
    return repeated(blurred(vectors, side, repeats_), std::min(count, vectors.dimensions), size);
  };
  AppearanceVectors coarse = first(4, kCoarse);
  for (float& value : coarse.values) value *= kCoarseWeight;
  fine_ = sideBySide(first(1, kFine), coarse);
  quick_ = repeated(first(2, kQuick), kQuick, size);
  findSimilar();
}

void PatchSource::findSimilar() {
  const int count = region_.width * region_.height;
  similar_.resize(static_cast<std::size_t>(count) * kSimilar);
  tbb::parallel_for(0, region_.height, [&](int row) {
    std::mt19937_64 random(static_cast<std::uint64_t>(row));
    std::vector<std::pair<float, int>> found;
    for (int column = 0; column < region_.width; ++column) {
      const glm::ivec2 texel(region_.x + column, region_.y + row);
      found.clear();
      for (int i = 0; i < kLookedAt; ++i) {
        const auto n = static_cast<int>(random() % static_cast<std::uint64_t>(count));
        if (isInPhase(lattice_, texelOf(n) - texel, kSimilarPhase))
          found.emplace_back(difference(texel, texelOf(n)), n);
      }
      const std::size_t kept = std::min(found.size(), kSimilar);
      std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
      for (std::size_t i = 0; i < kSimilar; ++i)
        similar_[indexOf(texel) * kSimilar + i] = i < kept ? texelOf(found[i].second) : texel;
    }
  });
}

glm::ivec2 PatchSource::texelOf(int n) const {
  return {region_.x + n % region_.width, region_.y + n / region_.width};
}

SourceRegion PatchSource::placesOf(glm::ivec2 size) const {
  // Of a sample that repeats, places further on are the same ones again.
  const int width = region_.width - size.x + 1, height = region_.height - size.y + 1;
  return {region_.x, region_.y, repeats_ ? std::min(width, sampleSize_.x) : width,
          repeats_ ? std::min(height, sampleSize_.y) : height};
}

glm::ivec2 PatchSource::sampleTexel(glm::ivec2 texel) const {
  return {texel.x % sampleSize_.x, texel.y % sampleSize_.y};
}

float PatchSource::difference(glm::ivec2 a, glm::ivec2 b) const {
  const float *p = fine_.at(a.x, a.y), *q = fine_.at(b.x, b.y);
  float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
  for (int d = 0; d < fine_.dimensions; ++d) sum += (p[d] - q[d]) * (p[d] - q[d]);
  return sum;
}

}  // namespace weft
