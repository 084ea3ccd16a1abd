#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "weft/core/Result.h"
#include "weft/materials/ChunkMaterial.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// What is between the centres of texels.
enum class TexelFilter {
  Nearest,   ///< the nearest texel: fast, with edges where texels are larger than pixels
  Bilinear,  ///< the results of the four nearest texels, mixed: four times the work
};

struct BTFMaterialOptions {
  /// Repetitions of the material per unit of texture coordinates; positive, because a mirrored image would
  /// need mirrored directions.
  glm::vec2 textureScale{1.0f};
  int interpolatedViews =
      3;  ///< 3: paper M eq. 4; 1: the nearest measured view alone, faster, with seams between views
  TexelFilter filter = TexelFilter::Nearest;
  /// Stores the layers of models that have lobes (`rfnl`) a second time, as environments are asked for them:
  /// frames under an environment take a third less, the material twice the memory.
  bool preparedForEnvironments = false;
  bool doubleSided = false;  ///< draw back faces, too, with the relief of the front seen in the mirror
};

/// A measured material, rendered from its reflectance field under point and directional lights (paper M 5.1
/// and 5.4) and an environment (5.2): chunks for the parameters, the view lookup and the program.
///
/// Needs meshes with texture coordinates and tangents; the texture repeats. GLSL: shaders/btf.frag, which
/// computes what ReflectanceField::evaluate() and underEnvironment() do.
class BTFMaterial : public ChunkMaterial {
 public:
  /// Fails on options that are none, and where the views do not fit into one array texture of 2,048 layers,
  /// which every GL 4.5 has.
  static Result<std::shared_ptr<BTFMaterial>> create(std::shared_ptr<const ReflectanceField> field,
                                                     const BTFMaterialOptions& options = {});

  const ReflectanceField& field() const { return *field_; }

 private:
  explicit BTFMaterial(std::shared_ptr<const ReflectanceField> field) : field_(std::move(field)) {}

  std::shared_ptr<const ReflectanceField> field_;
};

}  // namespace weft
