#pragma once

#include <memory>

#include "weft/chunks/State.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Material.h"
#include "weft/shaders/ShaderVariant.h"

namespace weft {

/// Light from all sides, infinitely far away, that its node turns (moving it changes nothing). A
/// scene has at most one. makeEnvironmentLight() of weft::materials makes it from a picture.
class EnvironmentLight : public Light {
 public:
  /// `lighting`: chunks that every program finds beside those of its material, in slots that
  /// materials leave empty; `variant`: what programs are told of them; `background`: what is drawn
  /// behind everything; `scale`: what the values of `lighting` are multiplied by.
  EnvironmentLight(State lighting, ShaderVariant variant, std::shared_ptr<const Material> background,
                   float scale)
      : lighting_(std::move(lighting)),
        variant_(std::move(variant)),
        background_(std::move(background)),
        scale_(scale) {}

  const State& lighting() const { return lighting_; }
  const ShaderVariant& variant() const { return variant_; }
  const std::shared_ptr<const Material>& background() const { return background_; }
  float scale() const { return scale_; }

  glm::vec3 intensity{1.0f};  ///< RGB, linear: what the picture's radiance is multiplied by
  bool showsBackground = true;

 private:
  State lighting_;
  ShaderVariant variant_;
  std::shared_ptr<const Material> background_;
  float scale_;
};

}  // namespace weft
