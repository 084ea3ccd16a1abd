#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace weft {

/// Square maps over the hemisphere of lights, for values that are known at the measured ones.
///
/// A map is Lambert's equal-area disc: q = (l.x, l.y) / sqrt(1 + l.z), whose edges +-1 lie on the
/// centres of the outermost texels; rows follow q.y. Between texels it is read bilinearly, which
/// gives the exact values at the measured lights. Between these it is a thin-plate spline; beyond
/// their hull it keeps the hull's values (as HemisphereTriangulation does). Immutable, thread safe.
class LightMaps {
 public:
  /// Lights: distinct unit vectors with z >= 0, at least one.
  explicit LightMaps(std::span<const glm::vec3> lights) : LightMaps(lights, sizeFor(lights.size())) {}
  LightMaps(std::span<const glm::vec3> lights, int size);

  /// The smallest even size with two texels in the disc for every light: 16 for 81 lights.
  static int sizeFor(std::size_t lights);

  int size() const { return size_; }
  /// Maps of some channels, `[row][column][channel]`, from their values `[light][channel]`.
  std::vector<float> filled(std::span<const float> values, std::size_t channels) const;

 private:
  int size_;
  std::size_t lights_;
  std::vector<float> weights_;  ///< `[row][column][light]`: every texel is a sum over lights
};

}  // namespace weft
