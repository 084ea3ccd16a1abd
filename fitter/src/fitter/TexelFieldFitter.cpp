#include "TexelFieldFitter.h"

#include <algorithm>

#include "weft/core/BatchEncoding.h"

namespace weft {
namespace {

// Measurements in linear values are shown by the simplest of displays.
Encoding displayEncoding(Encoding stored) {
  return stored == Encoding::Linear ? Encoding::Gamma22 : stored;
}

std::vector<glm::vec3> displayed(const TexelSamples& samples, Encoding stored) {
  std::vector<glm::vec3> values = samples.stored;
  if (stored == Encoding::Linear) encodeAll(displayEncoding(stored), floatsOf(values));
  return values;
}

}  // namespace

TexelFieldFitter::TexelFieldFitter(const FitProblem& problem, std::unique_ptr<TexelFitter> fitter)
    : model_(problem.model),
      weighted_(problem.weighted),
      encoding_(problem.encoding),
      fitter_(std::move(fitter)) {}

void TexelFieldFitter::fit(TexelRun& texels, RunParameters& parameters) const {
  for (int i = 0; i < texels.size(); ++i)
    fitTexel(texels.fitted(i), parameters.shared(i), parameters.layers(i));
}

void TexelFieldFitter::fitTexel(const TexelSamples& samples, std::span<float> shared,
                                std::span<float> layers) const {
  const glm::vec3 baseColor = weighted_ ? fitBaseColor(samples.linear) : fitPlainBaseColor(samples.stored);
  for (int c = 0; c < 3; ++c) shared[static_cast<std::size_t>(c)] = baseColor[c];

  const auto channels = static_cast<std::size_t>(model_->colorChannels());
  const std::size_t sharedCount = (shared.size() - 3) / channels;
  const std::size_t layerCount = layers.empty() ? 0 : model_->layerParameters().size();
  const std::size_t layerTotal = layerCount == 0 ? 0 : layers.size() / (layerCount * channels);
  std::vector<float> channelLayers(layerTotal * layerCount);
  for (std::size_t c = 0; c < channels; ++c) {
    const FitTargets targets = targetsOf(samples, c, baseColor);
    fitter_->fit(targets.values, targets.weights, shared.subspan(3 + c * sharedCount, sharedCount),
                 channelLayers);
    for (std::size_t layer = 0; layer < layerTotal; ++layer)
      std::copy_n(channelLayers.begin() + static_cast<std::ptrdiff_t>(layer * layerCount), layerCount,
                  layers.begin() + static_cast<std::ptrdiff_t>((layer * channels + c) * layerCount));
  }
}

FitTargets TexelFieldFitter::targetsOf(const TexelSamples& samples, std::size_t channel,
                                       glm::vec3 baseColor) const {
  if (model_->colorChannels() == 3)
    return channelTargets(weighted_ ? samples.linear : samples.stored, static_cast<int>(channel), baseColor,
                          weighted_);
  if (!weighted_) return plainLuminanceTargets(samples.stored);
  return luminanceTargets(samples.linear, displayed(samples, encoding_), displayEncoding(encoding_),
                          baseColor);
}

}  // namespace weft
