#include "weft/reflectance/ReflectanceField.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <span>

#include "weft/core/Contract.h"
#include "weft/reflectance/LevelSum.h"

namespace weft {
namespace {

Result<void> checkParameters(const FloatImage& image, const std::vector<std::string>& channels,
                             std::string_view what) {
  if (image.channels() != channels)
    return fail(fmt::format("the {} numbers are not those of the model", what));
  for (float value : image.values())
    if (!std::isfinite(value)) return fail(fmt::format("a {} number is not finite", what));
  return {};
}

Result<void> checkLevel(const FieldLevel& level, const FieldFormula& formula) {
  const auto& [shared, layers] = level;
  if (shared.empty() || shared.layers() != 1) return fail("the shared numbers are not one image");
  if (layers.layers() != formula.storedLayers())
    return fail(
        fmt::format("{} layers are described and {} are there", formula.storedLayers(), layers.layers()));
  if (!layers.empty() && (layers.width() != shared.width() || layers.height() != shared.height()))
    return fail("shared and layer numbers differ in size");
  WEFT_TRY_VOID(checkParameters(shared, formula.model().sharedChannels(), "shared"));
  return checkParameters(layers, formula.model().layerChannels(), "layer");
}

// The sides of all but the first, whose numbers have been checked.
Result<void> checkSides(std::span<const FieldLevel> levels) {
  const int width = levels[0].shared.width(), height = levels[0].shared.height();
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const FloatImage& finer = levels[i - 1].shared;
    if (finer.width() == 1 && finer.height() == 1)
      return fail(fmt::format("level {} of a field follows one of a single texel", i));
    const int levelWidth = sideOfLevel(width, static_cast<int>(i));
    const int levelHeight = sideOfLevel(height, static_cast<int>(i));
    if (levels[i].shared.width() != levelWidth || levels[i].shared.height() != levelHeight)
      return fail(fmt::format("level {} of a field of {} x {} texels has {} x {} instead of {} x {}", i,
                              width, height, levels[i].shared.width(), levels[i].shared.height(), levelWidth,
                              levelHeight));
  }
  return {};
}

}  // namespace

int sideOfLevel(int side, int level) {
  return level < 31 ? std::max(side >> level, 1) : 1;
}

Result<ReflectanceField> ReflectanceField::create(std::shared_ptr<const ReflectanceModel> model,
                                                  ReflectanceFieldDescription description,
                                                  std::vector<FieldLevel> levels, FieldTables tables) {
  auto sharedTables = std::make_shared<const FieldTables>(std::move(tables));
  WEFT_TRY(model, boundModel(std::move(model), sharedTables));
  WEFT_TRY(FieldFormula formula, FieldFormula::create(std::move(model), description));
  if (levels.empty()) return fail("a field has at least one level");
  for (const FieldLevel& level : levels) WEFT_TRY_VOID(checkLevel(level, formula));
  WEFT_TRY_VOID(checkSides(levels));
  if (const int summed = formula.model().summedLevels(); summed > 0 && summed != std::ssize(levels))
    return fail(fmt::format("the model sums {} levels and the field has {}", summed, levels.size()));

  ReflectanceField field(std::move(formula));
  field.description_ = std::move(description);
  field.levels_ = std::move(levels);
  field.tables_ = std::move(sharedTables);
  return field;
}

Result<ReflectanceField> ReflectanceField::create(std::shared_ptr<const ReflectanceModel> model,
                                                  ReflectanceFieldDescription description, FloatImage shared,
                                                  FloatImage layers) {
  std::vector<FieldLevel> levels(1);
  levels[0] = {std::move(shared), std::move(layers)};
  return create(std::move(model), std::move(description), std::move(levels));
}

namespace {

DirectionWeights onlyLayer(int layer) {
  return {{layer, layer, layer}, {1.0f, 0.0f, 0.0f}};
}

int wrapped(int place, int size) {
  return (place % size + size) % size;
}

// Of a surface of some texels, `texelAt(x, y)`, which repeats.
template <class TexelAt>
std::span<const float> filteredBetween(glm::ivec2 size, const TexelAt& texelAt, glm::vec2 place,
                                       std::vector<float>& filtered) {
  // Registered measured views are texels, up to rounding.
  constexpr float kRounding = 1e-3f;
  const glm::vec2 nearest = glm::round(place);
  const glm::vec2 low =
      glm::all(glm::lessThan(glm::abs(place - nearest), glm::vec2(kRounding))) ? nearest : glm::floor(place);
  const auto texel = [&](int dx, int dy) {
    return texelAt(wrapped(static_cast<int>(low.x) + dx, size.x),
                   wrapped(static_cast<int>(low.y) + dy, size.y));
  };
  if (low == nearest && glm::all(glm::lessThan(glm::abs(place - low), glm::vec2(kRounding))))
    return texel(0, 0);
  const glm::vec2 upper = place - low;
  filtered.assign(texel(0, 0).size(), 0.0f);
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const float weight = (dx == 1 ? upper.x : 1.0f - upper.x) * (dy == 1 ? upper.y : 1.0f - upper.y);
      const std::span<const float> corner = texel(dx, dy);
      for (std::size_t i = 0; i < filtered.size(); ++i) filtered[i] += weight * corner[i];
    }
  return filtered;
}

}  // namespace

std::span<const float> filteredTexel(const FloatImage& shared, glm::vec2 place,
                                     std::vector<float>& filtered) {
  return filteredBetween(
      {shared.width(), shared.height()}, [&](int x, int y) { return shared.texel(x, y); }, place, filtered);
}

std::span<const float> filteredTexel(const FloatImage& shared, const CoordinateMap& map, glm::vec2 place,
                                     std::vector<float>& filtered) {
  const auto shownAt = [&](int x, int y) {
    const glm::ivec2 shown = map.at(x, y);
    return shared.texel(shown.x, shown.y);
  };
  return filteredBetween({map.width(), map.height()}, shownAt, place, filtered);
}

std::span<const float> ReflectanceField::sharedFor(int x, int y, const DirectionWeights& layers,
                                                   glm::vec3 view, std::vector<float>& filtered) const {
  if (model().summedLevels() > 0) {
    numbersOfLevels(levels_, {x, y}, 0.0f, filtered);
    return filtered;
  }
  if (model().registration().empty()) return shared().texel(x, y);
  const glm::vec2 shift = formula_.shift(layers, view);
  return filteredTexel(shared(), glm::vec2(x, y) + glm::vec2(shift.x, -shift.y), filtered);
}

std::span<const float> ReflectanceField::layerAt(int x, int y, int layer) const {
  if (formula_.storedLayers() > 0) return layers().texel(x, y, layer);
  return formula_.layerOf({}, layer);
}

glm::vec3 ReflectanceField::evaluateLayer(int x, int y, int layer, glm::vec3 light, glm::vec3 view) const {
  return evaluate(x, y, onlyLayer(layer), light, view);
}

glm::vec3 ReflectanceField::evaluate(int x, int y, const DirectionWeights& layers, glm::vec3 light,
                                     glm::vec3 view) const {
  std::vector<float> filtered;
  return weighted(sharedFor(x, y, layers, view, filtered), x, y, layers, light, view);
}

glm::vec3 ReflectanceField::weighted(std::span<const float> shared, int x, int y,
                                     const DirectionWeights& layers, glm::vec3 light, glm::vec3 view) const {
  glm::vec3 sum(0.0f);
  for (int k = 0; k < 3; ++k)
    if (layers.weight[k] > 0.0f)
      sum += layers.weight[k] *
             formula_.evaluate(shared, layerAt(x, y, layers.index[static_cast<std::size_t>(k)]), light, view);
  return sum;
}

glm::vec3 ReflectanceField::evaluate(const CoordinateMap& map, int x, int y, const DirectionWeights& layers,
                                     glm::vec3 light, glm::vec3 view) const {
  WEFT_EXPECT(map.sampleWidth() == width() && map.sampleHeight() == height(), "the map is of this field");
  const glm::ivec2 shown = map.at(x, y);
  if (model().registration().empty()) return evaluate(shown.x, shown.y, layers, light, view);
  const glm::vec2 shift = formula_.shift(layers, view);
  std::vector<float> filtered;
  const std::span<const float> numbers =
      filteredTexel(shared(), map, glm::vec2(x, y) + glm::vec2(shift.x, -shift.y), filtered);
  return weighted(numbers, shown.x, shown.y, layers, light, view);
}

glm::vec3 ReflectanceField::evaluate(int x, int y, glm::vec3 light, glm::vec3 view) const {
  return evaluate(x, y, formula_.layersAround(light, view), light, view);
}

glm::vec3 ReflectanceField::underEnvironment(int x, int y, glm::vec3 view,
                                             const EnvironmentIntegrals& light) const {
  glm::vec3 sum(0.0f);
  if (!formula_.integratesEnvironments()) {
    const LightQuadrature& quadrature = formula_.quadrature();
    for (const LightQuadrature::Node& node : quadrature.nodes)
      sum += node.weight / node.light.z * light.average(node.light, quadrature.exponent) *
             evaluate(x, y, node.light, view);
    return sum;
  }
  const DirectionWeights layers = formula_.layersAround({0, 0, 1}, view);
  std::vector<float> filtered;
  const std::span<const float> shared = sharedFor(x, y, layers, view, filtered);
  for (int k = 0; k < 3; ++k)
    if (layers.weight[k] > 0.0f)
      sum += layers.weight[k] *
             formula_.underEnvironment(shared, layerAt(x, y, layers.index[static_cast<std::size_t>(k)]), view,
                                       light);
  return sum;
}

}  // namespace weft
