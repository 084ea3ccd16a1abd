#pragma once

#include <algorithm>

#include "weft/reflectance/ModelRegistry.h"

namespace weft::test {

/// A model that is not one of Weft's, with an option and a table: for every view a number, the
/// texel's place in the table `ramp`, between whose texels it interpolates; times (n.l)^power,
/// `power` being the option.
class RampModel : public ReflectanceModel {
 public:
  static ModelType type() {
    return {"ramp",
            "A place in a table that all texels share, for every view.",
            {ModelOption::number("power", "the power of n.l", 1, 0, 3)},
            [](ModelOptions options) { return std::make_shared<const RampModel>(std::move(options)); }};
  }

  /// Weft's models and this one.
  static ModelRegistry registry() {
    ModelRegistry models = ModelRegistry::builtin();
    models.add(type());
    return models;
  }

  explicit RampModel(ModelOptions options, std::shared_ptr<const FieldTables> tables = nullptr)
      : ReflectanceModel(std::move(options)), tables_(std::move(tables)) {}

  std::vector<std::string> layerParameters() const override { return {"place"}; }
  std::vector<ModelTable> tables() const override { return {{"ramp", {"value"}, 0, 1}}; }

  Result<std::shared_ptr<const ReflectanceModel>> bind(
      std::shared_ptr<const FieldTables> tables) const override {
    if (tables->at("ramp").width() < 2) return fail("a ramp has two ends");
    return std::make_shared<const RampModel>(options(), std::move(tables));
  }

  float evaluate(std::span<const float>, std::span<const float> layer, glm::vec3 light,
                 glm::vec3) const override {
    const FloatImage& ramp = tables_->at("ramp");
    const float place = std::clamp(layer[0], 0.0f, 1.0f) * static_cast<float>(ramp.width() - 1);
    const int left = std::min(static_cast<int>(place), ramp.width() - 2);
    const float share = place - static_cast<float>(left);
    float value = (1.0f - share) * ramp.at(left, 0, 0) + share * ramp.at(left + 1, 0, 0);
    for (int i = 0; i < options().number("power"); ++i) value *= light.z;
    return std::max(value, 0.0f);
  }

  std::string shaderFile() const override { return "ramp.glsl"; }
  std::string shaderText() const override {
    return R"(
layout(binding = TABLE_ramp) uniform sampler2DArray ramp;

float evaluateModel(SharedParameters shared_, LayerParameters layer, vec3 light, vec3 view) {
  int last = textureSize(ramp, 0).x - 1;
  float place = clamp(layer.texels[0].x, 0.0, 1.0) * float(last);
  int left = min(int(place), last - 1);
  float value = mix(texelFetch(ramp, ivec3(left, 0, 0), 0).r, texelFetch(ramp, ivec3(left + 1, 0, 0), 0).r,
                    place - float(left));
  for (int i = 0; i < POWER; ++i) value *= light.z;
  return diffusePart * max(value, 0.0);
}
)";
  }
  std::map<std::string, std::string> shaderDefines() const override {
    return {{"POWER", std::to_string(options().number("power"))}};
  }

 private:
  std::shared_ptr<const FieldTables> tables_;
};

}  // namespace weft::test
