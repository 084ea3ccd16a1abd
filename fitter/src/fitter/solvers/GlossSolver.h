#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/core/Result.h"
#include "weft/reflectance/GlossLobe.h"

namespace weft {

/// Fits the lobe of a texel to what its neighbours in the directions do not say of a sample: the
/// sample minus what is interpolated from the lights around its own, and likewise from the views.
///
/// Shading that changes slowly is no part of that, nor of what has to be known of the surface. And
/// it is the very error that a lobe is there for, that of directions which nobody measured. A lobe
/// that explains too little of it is none. Thread safe.
class GlossSolver {
 public:
  /// Fails where there are too few views or lights, or none that can be interpolated. `typical`:
  /// values of the pairs, `[view][light]`, n.l included; errors count as a display shows them
  /// there.
  static Result<GlossSolver> create(std::span<const glm::vec3> views, std::span<const glm::vec3> lights,
                                    std::span<const float> typical);

  /// Of some texels, `[texel][view][light]`, n.l included. The lobes are as a field keeps them,
  /// rounded to bytes. A result does not depend on other texels.
  std::vector<GlossLobe> solve(std::span<const float> values) const;
  /// What a lobe gives at the pairs, n.l included.
  std::vector<float> valuesOf(const GlossLobe& lobe) const;

 private:
  static constexpr std::size_t kTaps = 4;
  /// A sample, then what is interpolated, as pairs and their factors.
  struct Residual {
    std::uint32_t pair[kTaps];
    float factor[kTaps];
  };
  /// A lobe of the dictionary, and where it is large.
  struct Shape {
    GlossLobe lobe;
    std::vector<std::uint32_t> residuals;  ///< which of all
    std::vector<std::uint32_t> pairs;      ///< that they are made of
    std::vector<Residual> ofPairs;         ///< they, of the pairs above
  };
  struct Fit;

  GlossSolver(std::span<const glm::vec3> views, std::span<const glm::vec3> lights)
      : views_(views.begin(), views.end()), lights_(lights.begin(), lights.end()) {}
  std::size_t pairs() const { return views_.size() * lights_.size(); }
  Result<void> addResiduals(std::span<const float> typical);
  void addShape(const GlossLobe& lobe);
  float valueOf(const GlossLobe& lobe, std::size_t pair) const;
  GlossLobe fittedLobe(std::span<const float> residuals, const Shape& from) const;
  Fit fitAmount(const GlossLobe& lobe, const Shape& where, std::span<const float> targets) const;

  std::vector<glm::vec3> views_, lights_;
  std::vector<Residual> residuals_;  ///< of all pairs between lights, then between views
  std::vector<Shape> shapes_;
  std::vector<float> matches_;  ///< `[shape][pair]`: their product with values is the share of a shape
};

}  // namespace weft
