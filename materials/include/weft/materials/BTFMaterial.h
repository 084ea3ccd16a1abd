#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "weft/chunks/UniformBlockChunk.h"
#include "weft/core/Result.h"
#include "weft/materials/BTFMap.h"
#include "weft/materials/BTFMaterialOptions.h"
#include "weft/materials/BTFTextures.h"
#include "weft/materials/ChunkMaterial.h"

namespace weft {

/// A measured material, rendered from its reflectance field under point and directional lights
/// ([Meseth 2004] 5.1 and 5.4) and an environment (5.2): shared textures, and how they are shown.
///
/// Needs meshes with texture coordinates and tangents; the texture repeats. GLSL: shaders/btf.frag,
/// which computes what ReflectanceField::evaluate() and underEnvironment() do.
class BTFMaterial : public ChunkMaterial {
 public:
  /// Costs next to nothing. Fails on options that are none.
  static Result<std::shared_ptr<BTFMaterial>> create(std::shared_ptr<const BTFTextures> textures,
                                                     const BTFMaterialOptions& options = {});
  /// With textures of its own, which stay in memory; fails where BTFTextures::create() does, too.
  static Result<std::shared_ptr<BTFMaterial>> create(const std::shared_ptr<const ReflectanceField>& field,
                                                     const BTFMaterialOptions& options = {});

  const std::shared_ptr<const BTFTextures>& textures() const { return textures_; }
  const BTFMaterialOptions& options() const { return options_; }
  /// Shows the same textures otherwise. Scale, tint and exposure are numbers of a block; filter and
  /// views choose another program. Not while something is drawn. Fails on options that are none,
  /// and changes nothing then.
  Result<void> setOptions(const BTFMaterialOptions& options);

  /// What the sample's texels are put together to; null, as in the beginning: the sample repeats.
  const std::shared_ptr<const BTFMap>& map() const { return map_; }
  /// Not while something is drawn. Fails on a map that is not for these textures, and changes
  /// nothing then.
  Result<void> setMap(std::shared_ptr<const BTFMap> map);
  /// Texels that texture coordinates run over once: the map's, or the sample's; across and down.
  glm::ivec2 surfaceSize() const { return map_ ? map_->size() : textures_->size(); }

 private:
  BTFMaterial(std::shared_ptr<const BTFTextures> textures, const BTFMaterialOptions& options);
  void setProgram();

  std::shared_ptr<const BTFTextures> textures_;
  BTFMaterialOptions options_;
  std::shared_ptr<UniformBlockChunk> block_;
  std::shared_ptr<const BTFMap> map_;
};

}  // namespace weft
