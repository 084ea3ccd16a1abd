#include "weft/reflectance/ReflectanceField.h"

#include <fmt/format.h>

#include <cmath>

namespace weft {
namespace {

Result<void> checkNumbers(const FloatImage& image, const std::vector<std::string>& channels,
                          std::string_view what) {
  if (image.channels() != channels)
    return fail(fmt::format("the {} numbers are not those of the model", what));
  for (float value : image.values())
    if (!std::isfinite(value)) return fail(fmt::format("a {} number is not finite", what));
  return {};
}

}  // namespace

Result<ReflectanceField> ReflectanceField::create(std::shared_ptr<const ReflectanceModel> model,
                                                  ReflectanceFieldDescription description, FloatImage shared,
                                                  FloatImage layers) {
  WEFT_TRY(FieldFormula formula, FieldFormula::create(std::move(model), description));
  if (shared.empty() || shared.layers() != 1) return fail("the shared numbers are not one image");
  if (layers.layers() != formula.layerCount())
    return fail(
        fmt::format("{} layers are described and {} are there", formula.layerCount(), layers.layers()));
  if (!layers.empty() && (layers.width() != shared.width() || layers.height() != shared.height()))
    return fail("shared and layer numbers differ in size");
  WEFT_TRY_VOID(checkNumbers(shared, formula.model().sharedChannels(), "shared"));
  WEFT_TRY_VOID(checkNumbers(layers, formula.model().layerChannels(), "layer"));

  ReflectanceField field(std::move(formula));
  field.description_ = std::move(description);
  field.shared_ = std::move(shared);
  field.layers_ = std::move(layers);
  return field;
}

glm::vec3 ReflectanceField::evaluateLayer(int x, int y, int layer, glm::vec3 light, glm::vec3 view) const {
  return formula_.evaluate(shared_.texel(x, y), layers_.texel(x, y, layer), light, view);
}

glm::vec3 ReflectanceField::evaluate(int x, int y, const DirectionWeights& layers, glm::vec3 light,
                                     glm::vec3 view) const {
  glm::vec3 sum(0.0f);
  for (int k = 0; k < 3; ++k)
    if (layers.weight[k] > 0.0f)
      sum += layers.weight[k] * evaluateLayer(x, y, layers.index[static_cast<std::size_t>(k)], light, view);
  return sum;
}

glm::vec3 ReflectanceField::evaluate(int x, int y, glm::vec3 light, glm::vec3 view) const {
  return evaluate(x, y, formula_.layersAround(light, view), light, view);
}

glm::vec3 ReflectanceField::underEnvironment(int x, int y, glm::vec3 view, const SurfaceLight& light) const {
  glm::vec3 sum(0.0f);
  if (!formula_.integratesEnvironments()) {
    const LightQuadrature& quadrature = formula_.quadrature();
    for (const LightQuadrature::Node& node : quadrature.nodes)
      sum += node.weight / node.light.z * light.average(node.light, quadrature.exponent) *
             evaluate(x, y, node.light, view);
    return sum;
  }
  const DirectionWeights layers = formula_.layersAround({0, 0, 1}, view);
  for (int k = 0; k < 3; ++k)
    if (layers.weight[k] > 0.0f)
      sum += layers.weight[k] *
             formula_.underEnvironment(shared_.texel(x, y),
                                       layers_.texel(x, y, layers.index[static_cast<std::size_t>(k)]), view,
                                       light);
  return sum;
}

}  // namespace weft
