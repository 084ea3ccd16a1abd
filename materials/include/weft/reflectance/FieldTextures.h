#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <map>
#include <span>
#include <string>

#include "weft/core/TextureImage.h"
#include "weft/reflectance/LayerLookup.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// A field's parameters as textures for a GPU. With FieldProgram the one place that knows how they
/// lie in texels; shaders/fetch_texel.glsl reads them.
///
/// They have the field's levels. Both are arrays of RGBA texels, as precise as the field. A colour
/// channel has sharedTexels() of them for all layers, one after another: the base colour, and from
/// its alpha on the shared numbers. Of each layer it has layerTexels(), the numbers padded to whole
/// texels. Colour channels follow one another, then layers.
///
/// Where the hardware filters a model's parameters, its shared numbers are bytes, from the first
/// component on, and base colours a texture of their own: shaders/fetch_filtered.glsl reads them.
/// Where a model sums levels, its shared numbers are such bytes, and there are no base colours:
/// shaders/fetch_levels.glsl.
struct FieldTextures {
  TextureImage shared;
  TextureImage layers;  ///< empty for a model without layers
  /// ReflectanceModel::prepareForEnvironments(); empty where not asked for
  TextureImage preparedLayers;
  TextureImage baseColors;  ///< where parameters are filtered
  /// By name, their channels as shared numbers are packed, from the first component on.
  std::map<std::string, TextureImage> tables{};

  static FieldTextures create(const ReflectanceField& field, bool preparedForEnvironments = false);

  static int sharedTexels(const ReflectanceModel& model);
  static int layerTexels(const ReflectanceModel& model);
  /// How many array layers `layers` has.
  static int arrayLayers(const FieldFormula& formula);
  /// Whether preparedForEnvironments has an effect.
  static bool canBePrepared(const FieldFormula& formula);
};

/// `shared` and `baseColors` of a model whose parameters the hardware filters, from the levels of
/// one field or of several of one size, whose layers lie behind one another.
TextureImage packFilteredNumbers(std::initializer_list<std::span<const FieldLevel>> fields);
TextureImage packBaseColors(std::initializer_list<std::span<const FieldLevel>> fields);

/// Bytes of the textures that create() makes of a field, not prepared for environments.
std::uint64_t gpuBytes(const ReflectanceField& field);

/// The uniform block `ReflectanceField` of shaders/field_block.glsl, std140.
struct FieldBlock {
  glm::vec2 textureScale{1.0f};  ///< repetitions per unit of texture coordinates
  float lowestLightZ = 0.0f;     ///< FieldFormula's
  float lowestViewZ = 0.0f;      ///< likewise
  glm::vec3 tint{1.0f};          ///< what is shown is multiplied by it
  float quadratureExponent = 1.0f;
  /// Of a model that filters its parameters: how many fours of them, not all 0, texels of a level
  /// have; those beyond the field's coarsest level have as many as that
  std::array<std::int32_t, 16> weightsOfLevels{};
};

/// What a program must know of a field beside FieldTextures to show it: small, and the same for
/// every program.
struct FieldProgram {
  /// `#define NAME VALUE`; TABLE_NAME: a table's unit
  std::map<std::string, std::string> defines;
  std::map<std::string, std::string> includeAliases;  ///< as ShaderSource's
  std::map<std::string, std::string> texts;           ///< likewise
  FieldBlock block;
  LayerLookup lookup;  ///< empty for a model without layers
  /// a texel a node: light, weight; empty where the model's formula integrates
  FloatImage quadrature;

  static FieldProgram create(const ReflectanceField& field);
};

}  // namespace weft
