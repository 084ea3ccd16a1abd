#pragma once

#include <glm/vec4.hpp>
#include <memory>

#include "weft/chunks/GLContext.h"
#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// What is rendered into: linear RGBA, half or float, with a depth buffer. One picture per context
/// that renders into it.
class RenderTarget {
 public:
  /// Sizes must be positive.
  RenderTarget(int width, int height, Precision precision = Precision::Half);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Makes the picture in the context, which bindAndClear() otherwise does. Fails where it is
  /// larger than GL allows or has memory for, and says how large one of this shape may be.
  Result<void> prepare(GLContext& context) const;

  /// Makes it the place that is drawn to, over its whole area, and clears it to linear RGBA;
  /// unbind() ends that. What prepare() fails on is reported to the context.
  void bindAndClear(GLContext& context, const glm::vec4& background) const;
  static void unbind();

  /// The picture, channels R, G, B, A; zeros where nothing was rendered. `downsample` n averages n
  /// x n pixels into one (supersampling) and must divide both sizes.
  FloatImage read(GLContext& context, int downsample = 1) const;

 private:
  int width_;
  int height_;
  Precision precision_;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

}  // namespace weft
