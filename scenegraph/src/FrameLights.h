#pragma once

#include <vector>

#include "FlatScene.h"
#include "FrameBlock.h"
#include "View.h"
#include "weft/core/Result.h"
#include "weft/scenegraph/EnvironmentLight.h"
#include "weft/shaders/ShaderVariant.h"

namespace weft {

/// The lights of a frame.
struct FrameLights {
  /// Fails on more than kMaximumLights, and on more than one environment.
  static Result<FrameLights> of(const FlatScene& scene, const View& view);

  /// Writes them into the block, around the view's place.
  void fill(FrameBlock& block, const View& view) const;
  /// What programs are told of them.
  ShaderVariant variant() const;

  std::vector<PlacedLight> placed;  ///< the directional ones first
  std::size_t directional = 0;      ///< how many these are
  const EnvironmentLight* environment = nullptr;
  glm::dmat4 environmentToWorld{1.0};
};

}  // namespace weft
