#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "Lattice.h"
#include "SourceRegion.h"
#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// A sample as patches are cut from it: where a patch may lie, and how unlike two texels are.
/// A sample that repeats is repeated as far as a patch reaches.
class PatchSource {
 public:
  /// `reach`: about the largest side of a patch, by which a sample that repeats is extended.
  PatchSource(const AppearanceSample& sample, int reach);

  /// Where the top left texel of a patch of this size may lie.
  SourceRegion placesOf(glm::ivec2 size) const;
  bool contains(glm::ivec2 texel) const {
    return texel.x >= region_.x && texel.y >= region_.y && texel.x < region_.x + region_.width &&
           texel.y < region_.y + region_.height;
  }
  const Lattice& lattice() const { return lattice_; }
  /// The texel of the sample that a texel of this source is.
  glm::ivec2 sampleTexel(glm::ivec2 texel) const;

  /// How unlike two texels look, squared: at their place, and in the mean of what is around them,
  /// so that cuts also agree where they are seen from far away.
  float difference(glm::ivec2 a, glm::ivec2 b) const;
  /// Some texels that look about like one: the best of many at random.
  std::span<const glm::ivec2> similarTo(glm::ivec2 texel) const {
    return std::span(similar_).subspan(indexOf(texel) * kSimilar, kSimilar);
  }
  /// The strongest dimensions, smoothed, for a quick comparison.
  static constexpr int kQuick = 8;
  const float* quick(glm::ivec2 texel) const { return quick_.at(texel.x, texel.y); }

 private:
  static constexpr std::size_t kSimilar = 8;
  std::size_t indexOf(glm::ivec2 texel) const {
    return static_cast<std::size_t>((texel.y - region_.y) * region_.width + texel.x - region_.x);
  }
  glm::ivec2 texelOf(int n) const;
  void findSimilar();

  SourceRegion region_;
  glm::ivec2 sampleSize_;
  bool repeats_;
  Lattice lattice_;
  AppearanceVectors fine_;
  AppearanceVectors quick_;
  std::vector<glm::ivec2> similar_;  ///< `[texel of the region][kSimilar]`
};

}  // namespace weft
