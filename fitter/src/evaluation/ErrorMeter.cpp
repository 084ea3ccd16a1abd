#include "weft/evaluation/ErrorMeter.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <iterator>

#include "weft/core/BatchEncoding.h"

namespace weft {

FitErrors summarize(std::span<const SplitErrors> texels, TexelErrors SplitErrors::*part) {
  std::vector<TexelErrors> errors;
  for (const SplitErrors& texel : texels) errors.push_back(texel.*part);
  return summarize(errors);
}

ErrorMeter::ErrorMeter(FieldFormula formula, FittedPairs pairs, const BtfDescription& measured)
    : formula_(std::move(formula)),
      pairs_(std::move(pairs)),
      views_(measured.views),
      lights_(measured.lights),
      encoding_(measured.encoding),
      modelledLights_(formula_.modelledLights(measured.lights)),
      layersAreLights_(formula_.model().layerDirections() == LayerDirections::Lights) {
  for (glm::vec3 direction : layersAreLights_ ? lights_ : views_)
    layers_.push_back(formula_.layersAround(direction, direction));
  runs_ = findRuns();
}

// The layers and weights around a view, or light.
template <class Function>
void ErrorMeter::forEachLayer(std::size_t direction, const Function& function) const {
  const DirectionWeights& around = layers_[direction];
  for (int k = 0; k < 3; ++k) {
    // Measured directions are layers themselves, but for rounding.
    if (around.weight[k] < 1e-4f) continue;
    function(around.index[static_cast<std::size_t>(k)], around.weight[k] > 0.9999f ? 1.0f : around.weight[k]);
  }
}

void ErrorMeter::evaluateView(std::span<const float> shared, std::span<const float> layers, std::size_t view,
                              std::span<glm::vec3> values) const {
  if (layersAreLights_) {
    std::ranges::fill(values, glm::vec3(0.0f));
    for (std::size_t light = 0; light < lights_.size(); ++light)
      forEachLayer(light, [&](int layer, float weight) {
        values[light] +=
            weight * formula_.evaluate(shared, formula_.layerOf(layers, layer), lights_[light], views_[view]);
      });
    return;
  }
  bool isFirst = true;
  std::vector<glm::vec3> ofLayer;
  forEachLayer(view, [&](int layer, float weight) {
    if (isFirst) {
      formula_.evaluateLights(shared, layers, layer, modelledLights_, views_[view], values);
      if (weight != 1.0f)
        for (glm::vec3& value : values) value *= weight;
    } else {
      ofLayer.resize(values.size());
      formula_.evaluateLights(shared, layers, layer, modelledLights_, views_[view], ofLayer);
      for (std::size_t light = 0; light < values.size(); ++light) values[light] += weight * ofLayer[light];
    }
    isFirst = false;
  });
}

std::vector<ErrorMeter::Run> ErrorMeter::findRuns() const {
  std::vector<Run> runs;
  for (std::size_t view = 0; view < views_.size(); ++view)
    for (std::size_t light = 0; light < lights_.size(); ++light) {
      if (lights_[light].z <= 0.0f) continue;
      const bool isFitted = pairs_.views()[view] && pairs_.lights()[light];
      const bool continues = !runs.empty() && runs.back().view == view &&
                             runs.back().firstLight + runs.back().count == light &&
                             runs.back().isFitted == isFitted;
      if (!continues) runs.push_back({view, light, 0, isFitted});
      ++runs.back().count;
    }
  return runs;
}

template <class SharedOf>
SplitErrors ErrorMeter::measureTexel(const SharedOf& sharedOf, std::span<const float> layers,
                                     const TexelSamples& samples) const {
  const float grazingZ = std::cos(glm::radians(59.9f));
  const std::size_t lightCount = lights_.size();
  SplitErrors errors;
  std::vector<glm::vec3> model(2 * lightCount);
  const std::span<glm::vec3> linearModel = std::span(model).first(lightCount);
  const std::span<glm::vec3> storedModel = std::span(model).last(lightCount);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Run& run = runs_[i];
    if (i == 0 || runs_[i - 1].view != run.view) {
      evaluateView(sharedOf(run.view), layers, run.view, linearModel);
      std::ranges::copy(linearModel, storedModel.begin());
      encodeAll(encoding_, floatsOf(storedModel));
    }
    const std::size_t from = run.view * lightCount + run.firstLight;
    (run.isFitted ? errors.fitted : errors.heldOut)
        .add({.linear = std::span(samples.linear).subspan(from, run.count),
              .stored = std::span(samples.stored).subspan(from, run.count)},
             {.linear = linearModel.subspan(run.firstLight, run.count),
              .stored = storedModel.subspan(run.firstLight, run.count)},
             views_[run.view].z < grazingZ);
  }
  return errors;
}

void ErrorMeter::measure(const RunParameters& parameters, TexelRun& texels,
                         std::span<SplitErrors> errors) const {
  WEFT_EXPECT(parameters.size() == texels.size() && std::ssize(errors) == texels.size(), "all of one run");
  for (int i = 0; i < texels.size(); ++i)
    errors[static_cast<std::size_t>(i)] = measureTexel([&](std::size_t) { return parameters.shared(i); },
                                                       parameters.layers(i), texels.measured(i));
}

void ErrorMeter::measure(const ReflectanceField& field, TexelRun& texels,
                         std::span<SplitErrors> errors) const {
  WEFT_EXPECT(std::ssize(errors) == texels.size(), "an error a texel");
  std::vector<float> layers, filtered;
  for (int i = 0; i < texels.size(); ++i) {
    const int x = texels.x() + i, y = texels.y();
    layers.clear();
    for (int layer = 0; layer < field.layers().layers(); ++layer)
      std::ranges::copy(field.layers().texel(x, y, layer), std::back_inserter(layers));
    const auto sharedOf = [&](std::size_t view) { return field.sharedSeenAt(x, y, views_[view], filtered); };
    errors[static_cast<std::size_t>(i)] = measureTexel(sharedOf, layers, texels.measured(i));
  }
}

}  // namespace weft
