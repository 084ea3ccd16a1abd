#include "models/LafFitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/LightSpacing.h"
#include "weft/reflectance/LafModel.h"

namespace weft {
namespace {

// What a view may show at most, for its brightest sample: well below the white pixel of [Meseth
// 2004] 5.3, 1.5 times that sample. Views that are all but black beside others would otherwise hold
// the whole texel down.
std::vector<float> ceilingsFor(std::span<const float> targets, std::size_t views) {
  const std::size_t lights = targets.size() / views;
  const float brightest = std::max(std::ranges::max(targets), 0.0f);
  std::vector<float> ceilings;
  for (std::size_t v = 0; v < views; ++v)
    ceilings.push_back(1.33f *
                       std::max(std::ranges::max(targets.subspan(v * lights, lights)), 0.04f * brightest));
  return ceilings;
}

// The view factors of `slaf` and the job that they leave for the lobes.
class ViewFactors {
 public:
  ViewFactors(const LafJob& job, std::size_t views)
      : job_(job), lights_(job.targets.size() / views), factors_(views, 1.0f), scaled_(job.scales.size()) {
    scale();
  }

  const std::vector<float>& factors() const { return factors_; }
  LafJob job() const { return {job_.targets, scaled_}; }

  // The best for values of the lobes, `[view][light]`, in closed form; 1 for a view that nothing is
  // known of.
  void solve(std::span<const float> values) {
    for (std::size_t v = 0; v < factors_.size(); ++v) {
      double product = 0.0;
      double square = 0.0;
      for (std::size_t i = v * lights_; i < (v + 1) * lights_; ++i) {
        const double scaled = double{job_.scales[i]} * values[i];
        product += scaled * job_.targets[i];
        square += scaled * scaled;
      }
      factors_[v] = square > 0.0 ? static_cast<float>(std::max(product / square, 0.0)) : 1.0f;
    }
    scale();
  }

  // Before lobes are known: alternates with the best value for every product of light and view.
  void solveWithoutLobes(std::span<const std::uint32_t> groups, std::size_t groupCount) {
    std::vector<float> values(groups.size());
    for (int round = 0; round < 5; ++round) {
      std::vector<double> products(groupCount, 0.0);
      std::vector<double> squares(groupCount, 1e-30);
      for (std::size_t i = 0; i < groups.size(); ++i) {
        products[groups[i]] += double{scaled_[i]} * job_.targets[i];
        squares[groups[i]] += double{scaled_[i]} * scaled_[i];
      }
      for (std::size_t i = 0; i < groups.size(); ++i)
        values[i] = static_cast<float>(products[groups[i]] / squares[groups[i]]);
      solve(values);
    }
  }

  // Lowers the factors of views that would show more than their ceiling.
  void limit(std::span<const float> peaks, std::span<const float> ceilings) {
    for (std::size_t v = 0; v < factors_.size(); ++v)
      if (factors_[v] * peaks[v] > ceilings[v]) factors_[v] = ceilings[v] / peaks[v];
  }

  // Makes their mean 1, which only moves brightness into the lobes.
  void normalize(LafFit& fit) {
    double sum = 0.0;
    for (const float factor : factors_) sum += factor;
    const auto mean = static_cast<float>(sum / static_cast<double>(factors_.size()));
    if (!(mean > 0.0f)) return;
    for (float& factor : factors_) factor /= mean;
    fit.diffuse *= mean;
    for (LafLobe& lobe : fit.lobes) lobe.amplitude *= mean;
  }

 private:
  void scale() {
    for (std::size_t i = 0; i < scaled_.size(); ++i) scaled_[i] = job_.scales[i] * factors_[i / lights_];
  }

  LafJob job_;
  std::size_t lights_;
  std::vector<float> factors_;
  std::vector<float> scaled_;  // the job's scales times the factors
};

void write(const LafFit& fit, std::span<float> shared) {
  constexpr float largest = 60000.0f;  // of a half, nearly
  shared[0] = std::min(fit.diffuse, largest);
  for (std::size_t j = 0; j < fit.lobes.size(); ++j) {
    const LafLobe& lobe = fit.lobes[j];
    const glm::vec2 axes = packedLafAxes(lobe.axes);
    std::ranges::copy(std::array{std::min(lobe.amplitude, largest), axes.x, axes.y, lobe.exponent},
                      shared.subspan(1 + 4 * j).begin());
  }
}

}  // namespace

Result<std::unique_ptr<TexelFitter>> LafFitter::create(const FitProblem& problem) {
  const std::size_t samples = problem.views.size() * problem.lights.size();
  const std::size_t numbers = problem.model->sharedParameters().size() +
                              problem.model->layerParameters().size() * problem.views.size();
  if (samples < numbers)
    return fail(fmt::format("{} samples a texel do not determine the {} numbers of {}", samples, numbers,
                            problem.model->description().name),
                {}, "measure more lights or views, or fit fewer lobes");
  return std::unique_ptr<TexelFitter>(new LafFitter(problem));
}

LafFitter::LafFitter(const FitProblem& problem)
    : solver_({problem.views, problem.lights, problem.cosineInModel, sharpestExponent(problem.lights)}),
      lobes_(problem.model->options().number("lobes")),
      hasViewFactor_(problem.model->layerDirections() == LayerDirections::Views) {
  for (const glm::vec3 light : problem.lights)
    cosines_.push_back(problem.cosineInModel ? 1.0f : std::max(light.z, 0.0f));
}

void LafFitter::fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
                    std::span<float> layers) const {
  std::vector<float> weighted(targets.size());
  std::vector<float> scales(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    weighted[i] = weights[i] * targets[i];
    scales[i] = weights[i] * cosines_[i % cosines_.size()];
  }
  const LafJob job{weighted, scales};
  const std::vector<float> ceilings = ceilingsFor(targets, targets.size() / cosines_.size());
  if (!hasViewFactor_) {
    LafFit fit = solver_.fit(job, lobes_);
    solver_.limit(job, ceilings, fit);
    write(fit, shared);
    return;
  }
  ViewFactors factors(job, layers.size());
  factors.solveWithoutLobes(solver_.groups(), solver_.groupCount());
  LafFit fit = solver_.fit(factors.job(), lobes_);
  constexpr int rounds = 8;  // ten times as many change the error by less than 0.2 %
  for (int round = 0; round < rounds; ++round) {
    factors.solve(solver_.values(fit));
    solver_.improve(factors.job(), 4, fit);
  }
  factors.limit(solver_.peaks(fit), ceilings);
  factors.normalize(fit);
  write(fit, shared);
  std::ranges::copy(factors.factors(), layers.begin());
}

}  // namespace weft
