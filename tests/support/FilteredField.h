#pragma once

#include <array>

#include "SomeModels.h"
#include "TestSupport.h"
#include "weft/reflectance/BoxAverages.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft::test {

inline ReflectanceField withLevels(const ReflectanceField& field, std::vector<FieldLevel> levels) {
  FieldTables tables = field.tables();
  for (float& number : tables.at("registration").values()) number = 0.0f;
  const auto model = valueOf(ModelRegistry::builtin().create(field.model().description()));
  return valueOf(ReflectanceField::create(model, field.description(), std::move(levels), std::move(tables)));
}

/// A field of `loom` of eight components, without relief, in one colour; its coarser levels are
/// averages.
inline ReflectanceField filteredField(int side) {
  const ReflectanceField uneven = unevenField({"loom", {{"components", 8}}}, side, side);
  std::vector<FieldLevel> levels{{uneven.shared(), {}}};
  FloatImage& finest = levels[0].shared;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      std::ranges::copy(std::array{0.5f, 0.25f, 0.75f}, finest.texel(x, y).begin());
  for (int coarse = side / 2; coarse >= 1; coarse /= 2) {
    const FloatImage& finer = levels.back().shared;
    FloatImage shared(coarse, coarse, finer.channels());
    const auto averages = boxAverages(glm::ivec2(finer.width()), glm::ivec2(coarse),
                                      static_cast<std::size_t>(finer.channelCount()),
                                      [&](int x, int y) { return finer.texel(x, y).data(); });
    std::ranges::copy(averages, shared.values().begin());
    levels.push_back({std::move(shared), {}});
  }
  return withLevels(uneven, std::move(levels));
}

/// What numbers show, between three layers.
inline glm::vec3 valueOfNumbers(const ReflectanceField& field, std::span<const float> numbers,
                                const DirectionWeights& layers, glm::vec3 light, glm::vec3 view) {
  glm::vec3 value(0.0f);
  for (std::size_t k = 0; k < 3; ++k)
    value += layers.weight[static_cast<int>(k)] *
             field.formula().evaluate(numbers, field.formula().layerOf({}, layers.index[k]), light, view);
  return value;
}

}  // namespace weft::test
