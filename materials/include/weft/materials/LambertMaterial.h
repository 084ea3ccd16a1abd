#pragma once

#include <glm/vec4.hpp>
#include <memory>

#include "weft/core/Image.h"
#include "weft/materials/ChunkMaterial.h"

namespace weft {

struct LambertOptions {
  glm::vec4 baseColor{1.0f};                        ///< linear RGB and alpha
  std::shared_ptr<const Image> baseColorTexture{};  ///< sRGB, multiplied; null for none
  bool doubleSided = false;                         ///< draw and light back faces, too
};

/// A diffuse surface: radiance = baseColor / pi x irradiance x n.l. What materials without a BTF
/// are drawn with. GLSL: shaders/lambert.frag.
class LambertMaterial : public ChunkMaterial {
 public:
  explicit LambertMaterial(const LambertOptions& options = {});
};

}  // namespace weft
