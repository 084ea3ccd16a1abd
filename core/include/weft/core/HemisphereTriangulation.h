#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Three directions of a set and their weights (>= 0, sum 1) for a direction between them.
struct DirectionWeights {
  std::array<int, 3> index{};
  glm::vec3 weight{1.0f, 0.0f, 0.0f};

  /// The index of the largest weight: what "nearest view" means everywhere in Weft.
  int nearest() const;
};

/// The Delaunay triangulation of measured directions in the parabolic plane ([Meseth 2004] 5.1;
/// conventions.md, "Between what was measured").
///
/// Beyond the hull of the directions a query is moved towards the pole until it meets the hull, so
/// that it is interpolated by azimuth between the two outermost neighbours and never darkens.
/// Directions below the horizon count as on it. Cocircular points are decided by their order, so
/// equal input gives equal triangles. Immutable, thread safe.
class HemisphereTriangulation {
 public:
  /// One triangle. The barycentric weight of corner k at the parabolic point p is the dot product
  /// of `weightRows[k]` and (p.x, p.y, 1).
  struct Triangle {
    std::array<int, 3> corner{};
    std::array<bool, 3> hullEdge{};  ///< the edge opposite of corner k lies on the hull
    std::array<glm::vec3, 3> weightRows{};

    /// Weights at `p`, with the hull rule applied and negative ones clamped and renormalised:
    /// exactly what the shader does.
    DirectionWeights weightsAt(glm::vec2 p) const;
  };

  /// Directions must be distinct unit vectors with z >= 0; fails on fewer than one, on duplicates
  /// and where two or more all lie on one circle through the pole's antipode (a line in the plane).
  /// One direction alone makes one triangle that gives it weight 1 everywhere.
  static Result<HemisphereTriangulation> create(std::span<const glm::vec3> directions);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The triangle that holds the parabolic point, or the hull triangle in whose sector it lies.
  int triangleAt(glm::vec2 p) const;
  /// Exact interpolation weights for a direction (need not be of unit length; z < 0 counts as 0).
  DirectionWeights locate(glm::vec3 direction) const;

 private:
  std::vector<Triangle> triangles_;
};

/// The parabolic point of a view direction, which is first lifted to the horizon if it lies below.
glm::vec2 parabolicAboveHorizon(glm::vec3 direction);

}  // namespace weft
