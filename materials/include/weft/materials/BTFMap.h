#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "weft/materials/BTFTextures.h"
#include "weft/reflectance/CoordinateMap.h"

namespace weft {

/// A coordinate map for GL, made for one field: with it a BTFMaterial shows the map's surface
/// instead of the sample, over and over. Many materials may share it. Immutable, thread safe;
/// touches no GL until something is drawn.
class BTFMap {
 public:
  /// Packs the map, which may go then. What is packed stays in memory: two or four bytes a texel of
  /// the surface. Where the hardware filters the field's parameters, `field` is asked for the field
  /// that the textures were made of, and its textures are packed anew, with coarse levels of the
  /// surface behind them (mappedLevels()): twice their memory, in place of them. Fails where the
  /// map's sample has another size than the textures.
  static Result<std::shared_ptr<const BTFMap>> create(const CoordinateMap& map, const BTFTextures& textures,
                                                      const BTFTextures::FieldSource& field);

  /// Texels of the surface across and down.
  glm::ivec2 size() const { return size_; }
  /// Whether it may be shown with these textures.
  bool fits(const BTFTextures& textures) const {
    return textures.size() == sampleSize_ && textures.filtersParameters() == hasLevels_;
  }
  /// Slots and what belongs into them, in place of the textures' own.
  const std::vector<std::pair<unsigned, std::shared_ptr<const Chunk>>>& chunks() const { return chunks_; }

 private:
  BTFMap() = default;

  glm::ivec2 size_{};
  glm::ivec2 sampleSize_{};
  bool hasLevels_ = false;
  std::vector<std::pair<unsigned, std::shared_ptr<const Chunk>>> chunks_;
};

}  // namespace weft
