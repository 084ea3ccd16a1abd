#include "TexelJob.h"

#include <algorithm>
#include <cmath>

#include "FitWeights.h"
#include "weft/core/BatchEncoding.h"

namespace weft {

TexelJob::TexelJob(const BtfDescription& measured, const FitOptions& options, const ErrorMeter& meter,
                   const TexelFitter& fitter, const ReflectanceModel& model)
    : measured_(measured), options_(options), meter_(meter), fitter_(fitter), model_(model) {}

void TexelJob::fit(const SampleRows& rows, int row, int column, FittedRows& to, int x, int y) const {
  const TexelSamples samples = texelSamples(rows, measured_, row, column);
  const std::span<float> shared = to.shared.texel(x, y);
  const std::size_t channels = to.layers.channels().size();
  std::vector<float> layers(static_cast<std::size_t>(to.layers.layers()) * channels);
  if (meter_.fitsAllPairs())
    fitChannels(samples, shared, layers);
  else
    fitChannels({fittedOf(samples.linear), fittedOf(samples.stored)}, shared, layers);
  if (options_.precision == Precision::Half) {
    for (float& number : shared) number = roundToHalf(number);
    for (float& number : layers) number = roundToHalf(number);
  }
  for (int layer = 0; layer < to.layers.layers(); ++layer)
    std::copy_n(layers.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(layer) * channels),
                channels, to.layers.texel(x, y, layer).begin());
  to.errors[static_cast<std::size_t>(y) * static_cast<std::size_t>(to.shared.width()) +
            static_cast<std::size_t>(x)] = meter_.measure(shared, layers, samples.linear, samples.stored);
}

// Without the pairs that are held out, or not lit.
std::vector<glm::vec3> TexelJob::fittedOf(const std::vector<glm::vec3>& all) const {
  std::vector<glm::vec3> fitted;
  const std::vector<bool>& lights = meter_.fittedLights();
  for (std::size_t view = 0; view < meter_.fittedViews().size(); ++view)
    for (std::size_t light = 0; meter_.fittedViews()[view] && light < lights.size(); ++light)
      if (lights[light]) fitted.push_back(all[view * lights.size() + light]);
  return fitted;
}

// Measurements in linear values are shown by the simplest of displays.
Encoding TexelJob::displayEncoding() const {
  return measured_.encoding == Encoding::Linear ? Encoding::Gamma22 : measured_.encoding;
}

std::vector<glm::vec3> TexelJob::displayed(const TexelSamples& samples) const {
  std::vector<glm::vec3> values = samples.stored;
  if (measured_.encoding == Encoding::Linear) encodeAll(displayEncoding(), floatsOf(values));
  return values;
}

void TexelJob::fitChannels(const TexelSamples& samples, std::span<float> shared,
                           std::span<float> layers) const {
  const bool linear = options_.space == FitSpace::Linear;
  const std::vector<glm::vec3>& values = linear ? samples.linear : samples.stored;
  const glm::vec3 baseColor = linear ? fitBaseColor(values) : fitPlainBaseColor(values);
  for (int c = 0; c < 3; ++c) shared[static_cast<std::size_t>(c)] = baseColor[c];

  const auto channels = static_cast<std::size_t>(model_.colorChannels());
  const std::size_t sharedCount = (shared.size() - 3) / channels;
  const std::size_t layerCount = layers.empty() ? 0 : model_.layerNumbers().size();
  const std::size_t layerTotal = layerCount == 0 ? 0 : layers.size() / (layerCount * channels);
  std::vector<float> channelLayers(layerTotal * layerCount);
  for (std::size_t c = 0; c < channels; ++c) {
    FitTargets targets;
    if (channels == 3)
      targets = channelTargets(values, static_cast<int>(c), baseColor, linear);
    else if (linear)
      targets = luminanceTargets(values, displayed(samples), displayEncoding(), baseColor);
    else
      targets = plainLuminanceTargets(values);
    fitter_.fit(targets.values, targets.weights, shared.subspan(3 + c * sharedCount, sharedCount),
                channelLayers);
    for (std::size_t layer = 0; layer < layerTotal; ++layer)
      std::copy_n(channelLayers.begin() + static_cast<std::ptrdiff_t>(layer * layerCount), layerCount,
                  layers.begin() + static_cast<std::ptrdiff_t>((layer * channels + c) * layerCount));
  }
}

}  // namespace weft
