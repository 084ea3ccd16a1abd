#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/FieldFormula.h"

namespace weft {

/// Which pairs of a measurement a field was fitted to. The others are held out, but for those whose
/// light is on or below the horizon: whatever an image of them shows, the surface is not lit.
class FittedPairs {
 public:
  /// Those whose view and light are among the directions of `description`.
  FittedPairs(const ReflectanceFieldDescription& description, const BtfDescription& measured);

  /// Whether every measured pair was fitted.
  bool areAll() const { return areAll_; }
  /// Whether any pair is held out.
  bool holdOut() const { return holdOut_; }
  /// Which of the measured directions were fitted.
  const std::vector<bool>& views() const { return views_; }
  const std::vector<bool>& lights() const { return lights_; }
  /// Of the values of all pairs, `[view][light]`, those of fitted ones.
  std::vector<glm::vec3> of(const std::vector<glm::vec3>& all) const;

 private:
  std::vector<bool> views_;
  std::vector<bool> lights_;
  bool areAll_;
  bool holdOut_;
};

}  // namespace weft
