#include "weft/reflectance/ReflectanceField.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/core/Contract.h"

namespace weft {
namespace {

Result<void> checkParameters(const FloatImage& image, const std::vector<std::string>& channels,
                             std::string_view what) {
  if (image.channels() != channels)
    return fail(fmt::format("the {} parameters are not those of the model", what));
  for (float value : image.values())
    if (!std::isfinite(value)) return fail(fmt::format("a {} parameter is not a finite number", what));
  return {};
}

}  // namespace

glm::vec3 evaluateWithCosine(const ReflectanceModel& model, bool hasCosine, float lowestLightZ,
                             std::span<const float> shared, std::span<const float> view, glm::vec3 light) {
  if (light.z <= 0.0f) return glm::vec3(0.0f);
  if (!hasCosine) return light.z * model.evaluate(shared, view, light);
  if (light.z >= lowestLightZ) return model.evaluate(shared, view, light);
  const glm::vec2 across(light);  // 0 where rounding lets the pole lie below a ring at the pole
  const glm::vec2 azimuth = across / std::sqrt(std::max(glm::dot(across, across), 1e-30f));
  const glm::vec3 onRing(azimuth * std::sqrt(1.0f - lowestLightZ * lowestLightZ), lowestLightZ);
  return light.z / lowestLightZ * model.evaluate(shared, view, onRing);
}

float lowestZ(std::span<const glm::vec3> directions) {
  WEFT_EXPECT(!directions.empty(), "there are directions");
  return std::min_element(directions.begin(), directions.end(),
                          [](glm::vec3 a, glm::vec3 b) { return a.z < b.z; })
      ->z;
}

Result<ReflectanceField> ReflectanceField::create(std::shared_ptr<const ReflectanceModel> model,
                                                  ReflectanceFieldDescription description, FloatImage shared,
                                                  FloatImage views) {
  if (shared.empty() || shared.layers() != 1) return fail("the shared parameters are not one image");
  if (views.width() != shared.width() || views.height() != shared.height())
    return fail("shared and view parameters differ in size");
  if (views.layers() != static_cast<int>(description.views.size()))
    return fail(
        fmt::format("{} views are described and {} are there", description.views.size(), views.layers()));
  WEFT_TRY_VOID(checkParameters(shared, model->sharedChannels(), "shared"));
  WEFT_TRY_VOID(checkParameters(views, model->viewChannels(), "view"));
  if (description.lights.empty()) return fail("no light directions are described");
  for (glm::vec3 light : description.lights)
    if (!(std::abs(glm::length(light) - 1.0f) < 1e-3f))
      return fail("a light direction is not of unit length");

  ReflectanceField field;
  WEFT_TRY(field.triangulation_, HemisphereTriangulation::create(description.views));
  field.lowestLightZ_ = std::min(lowestZ(description.lights), 1.0f);  // of unit length but for rounding
  if (description.hasCosine && field.lowestLightZ_ <= 0.0f)
    return fail("a field that contains n.l has a light on or below the horizon");
  field.model_ = std::move(model);
  field.description_ = std::move(description);
  field.shared_ = std::move(shared);
  field.views_ = std::move(views);
  return field;
}

glm::vec3 ReflectanceField::evaluateView(int x, int y, int view, glm::vec3 light) const {
  return evaluateWithCosine(*model_, description_.hasCosine, lowestLightZ_, shared_.texel(x, y),
                            views_.texel(x, y, view), light);
}

glm::vec3 ReflectanceField::evaluate(int x, int y, const DirectionWeights& view, glm::vec3 light) const {
  glm::vec3 sum(0.0f);
  for (int k = 0; k < 3; ++k)
    if (view.weight[k] > 0.0f)
      sum += view.weight[k] * evaluateView(x, y, view.index[static_cast<std::size_t>(k)], light);
  return sum;
}

}  // namespace weft
