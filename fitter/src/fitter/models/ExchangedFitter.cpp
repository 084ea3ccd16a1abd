#include "models/ExchangedFitter.h"

#include <algorithm>

namespace weft {

Result<std::unique_ptr<TexelFitter>> ExchangedFitter::create(const FitProblem& problem, Factory factory) {
  FitProblem exchanged = problem;
  std::swap(exchanged.lights, exchanged.views);
  // n.l is the same for a whole layer, so it is taken out beforehand
  exchanged.cosineInModel = true;
  std::vector<float> cosines(problem.lights.size(), 1.0f);
  if (!problem.cosineInModel)
    std::ranges::transform(problem.lights, cosines.begin(),
                           [](glm::vec3 light) { return std::max(light.z, 0.0f); });
  WEFT_TRY(std::unique_ptr<TexelFitter> fitter, factory(exchanged));
  return std::unique_ptr<TexelFitter>(
      new ExchangedFitter(std::move(fitter), std::move(cosines), problem.views.size()));
}

void ExchangedFitter::fit(std::span<const float> targets, std::span<const float> weights,
                          std::span<float> shared, std::span<float> layers) const {
  const std::size_t lights = cosines_.size();
  std::vector<float> exchangedTargets(targets.size());
  std::vector<float> exchangedWeights(targets.size());
  for (std::size_t light = 0; light < lights; ++light)
    for (std::size_t view = 0; view < views_; ++view) {
      const std::size_t from = view * lights + light;
      const std::size_t to = light * views_ + view;
      // w (target - n.l LF) = w n.l (target / n.l - LF)
      if (cosines_[light] > 0.0f) exchangedTargets[to] = targets[from] / cosines_[light];
      exchangedWeights[to] = weights[from] * cosines_[light];
    }
  fitter_->fit(exchangedTargets, exchangedWeights, shared, layers);
}

}  // namespace weft
