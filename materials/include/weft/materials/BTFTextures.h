#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "weft/chunks/Chunk.h"
#include "weft/core/Result.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/shaders/ShaderSource.h"

namespace weft {

/// A reflectance field for GL: the heavy part of BTFMaterial, which many materials and scenes
/// share. Immutable, thread safe; touches no GL until something is drawn.
class BTFTextures {
 public:
  /// Reads the same field once more; called on the thread of any context.
  using FieldSource = std::function<Result<ReflectanceField>()>;

  /// Packs the field, which may go then. With a source nothing is kept in memory beside GL's copy:
  /// each context but the first to draw it has the field read once more. Without one what is packed
  /// stays.
  ///
  /// `preparedForEnvironments` stores the layers of models that have lobes (`rfnl`) a second time,
  /// as environments are asked for them: frames under an environment take a third less, for twice
  /// the memory. Fails where the views do not fit into one array texture of 2,048 layers, which
  /// every GL 4.5 has.
  static Result<std::shared_ptr<const BTFTextures>> create(const ReflectanceField& field,
                                                           bool preparedForEnvironments = false,
                                                           FieldSource source = {});

  /// Texels of the field across and down.
  glm::ivec2 size() const { return size_; }
  /// Measured views of the field.
  int views() const { return views_; }
  /// Slots and what belongs into them: all but the program and the uniform block.
  const std::vector<std::pair<unsigned, std::shared_ptr<const Chunk>>>& chunks() const { return chunks_; }
  /// The program, but for what a material chooses.
  const ShaderSource& source() const { return source_; }
  /// The uniform block, likewise.
  const FieldBlock& block() const { return block_; }
  /// Whether the hardware filters the parameters, over all levels.
  bool filtersParameters() const { return filtersParameters_; }
  /// Whether they do so down to one texel, the mean, which stochastic tiling needs.
  bool tilesAtRandom() const { return tilesAtRandom_; }
  /// Whether its model sums levels (ReflectanceModel::summedLevels()).
  bool sumsLevels() const { return sumsLevels_; }
  /// How many measured lights a pixel adds up under an environment; 0 where the model has a formula
  /// for it.
  int environmentLights() const { return environmentLights_; }

 private:
  BTFTextures() = default;
  void setProgram(FieldProgram program);
  void add(int unit, std::shared_ptr<const Chunk> chunk);

  glm::ivec2 size_{};
  int views_ = 0;
  std::vector<std::pair<unsigned, std::shared_ptr<const Chunk>>> chunks_;
  ShaderSource source_;
  FieldBlock block_;
  int environmentLights_ = 0;
  bool filtersParameters_ = false;
  bool tilesAtRandom_ = false;
  bool sumsLevels_ = false;
};

}  // namespace weft
