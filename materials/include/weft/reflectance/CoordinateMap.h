#pragma once

#include <cstddef>
#include <glm/ext/vector_uint2_sized.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// A large surface made of a small sample's texels: for each texel of the surface the texel of the
/// sample that it shows, as texture synthesis makes them ([Bosserhoff 2003] 4). The surface
/// repeats.
///
/// Immutable, thread safe.
class CoordinateMap {
 public:
  /// The most texels that the surface and the sample may have a side.
  static constexpr int kLargestSide = 16384;

  /// `texels`, row after row from the top, as in images, hold a column and a row of the sample
  /// each. `sampleName` says what the sample is, for people. Fails where sizes are below 1 or above
  /// kLargestSide, where there are more or fewer texels than width x height, and where one lies
  /// outside of the sample.
  static Result<CoordinateMap> create(int width, int height, int sampleWidth, int sampleHeight,
                                      std::vector<glm::u16vec2> texels, std::string sampleName = {});

  /// Of the surface.
  int width() const { return width_; }
  int height() const { return height_; }
  int sampleWidth() const { return sampleWidth_; }
  int sampleHeight() const { return sampleHeight_; }
  const std::string& sampleName() const { return sampleName_; }

  /// The texel of the sample, column and row, that a texel of the surface shows.
  glm::ivec2 at(int x, int y) const {
    return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  /// All of them, row after row.
  std::span<const glm::u16vec2> texels() const { return texels_; }

 private:
  CoordinateMap() = default;

  int width_ = 0;
  int height_ = 0;
  int sampleWidth_ = 0;
  int sampleHeight_ = 0;
  std::vector<glm::u16vec2> texels_;
  std::string sampleName_;
};

}  // namespace weft
