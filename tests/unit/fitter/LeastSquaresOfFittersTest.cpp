// What fitters promise: no smaller weighted sum of squares nearby.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "TexelFieldFitter.h"
#include "weft/fitter/FitterRegistry.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {
namespace {

using test::valueOf;

struct Numbers {
  std::vector<float> shared;
  std::vector<float> layers;
};

// Two lobes of l that lean away from v, over a diffuse albedo.
float reflectance(glm::vec3 v, glm::vec3 l) {
  const glm::vec3 glossy = glm::normalize(glm::vec3(-0.7f * v.x, -0.7f * v.y, v.z + 0.2f));
  const glm::vec3 broad = glm::normalize(glm::vec3(0.5f, 0.3f * v.y, 1.0f));
  return 0.3f + 0.3f * std::pow(std::max(glm::dot(glossy, l), 0.0f), 8.0f) +
         0.3f * std::pow(std::max(glm::dot(broad, l), 0.0f), 3.0f);
}

// Every other sample is brighter than the model can be beside the others, and counts ten times as
// much: the sum is far from its minimum wherever weights are ignored, or not squared.
class LeastSquaresOfFitters : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  LeastSquaresOfFitters() {
    const auto& [model, cosineInModel] = GetParam();
    problem.model = valueOf(ModelRegistry::builtin().create({.name = model}));
    problem.cosineInModel = cosineInModel;
    problem.lights = test::ubo2003Sampling();
    problem.views = model == "ptm" ? std::vector<glm::vec3>{{0, 0, 1}} : problem.lights;
    for (std::size_t v = 0; v < problem.views.size(); ++v)
      for (std::size_t l = 0; l < problem.lights.size(); ++l) {
        const bool isBright = (v + l) % 2 == 0;
        const glm::vec3 view = problem.views[v], light = problem.lights[l];
        targets.push_back((cosineInModel ? 1.0f : light.z) * (isBright ? 1.2f : 0.8f) *
                          (isOfLights() ? reflectance(light, view) : reflectance(view, light)));
        weights.push_back(isBright ? 3.0f : 0.3f);
      }
  }

  std::size_t layerCount() const {
    if (problem.model->layerDirections() == LayerDirections::None) return 0;
    return isOfLights() ? problem.lights.size() : problem.views.size();
  }
  bool isOfLights() const { return problem.model->layerDirections() == LayerDirections::Lights; }

  Numbers fit(const FitProblem& with, const std::vector<float>& factors) const {
    const auto fitter = valueOf(FitterRegistry::builtin().create(with));
    Numbers numbers{std::vector<float>(problem.model->sharedParameters().size()),
                    std::vector<float>(problem.model->layerParameters().size() * layerCount())};
    dynamic_cast<const TexelFieldFitter&>(*fitter).texelFitter().fit(targets, factors, numbers.shared,
                                                                     numbers.layers);
    return numbers;
  }

  double cost(const Numbers& numbers, std::size_t view, std::size_t light) const {
    const std::size_t count = problem.model->layerParameters().size();
    std::span<const float> layer;
    if (layerCount() > 0)
      layer = std::span(numbers.layers).subspan(count * (isOfLights() ? light : view), count);
    const float value =
        problem.model->evaluate(numbers.shared, layer, problem.lights[light], problem.views[view]);
    const float cosine = problem.cosineInModel ? 1.0f : problem.lights[light].z;
    const std::size_t pair = view * problem.lights.size() + light;
    return std::pow(double{weights[pair]} * double{targets[pair] - cosine * value}, 2.0);
  }

  double cost(const Numbers& numbers) const {
    double sum = 0.0;
    for (std::size_t view = 0; view < problem.views.size(); ++view)
      for (std::size_t light = 0; light < problem.lights.size(); ++light) sum += cost(numbers, view, light);
    return sum;
  }

  // Of the samples that see a layer's numbers.
  double layerCost(const Numbers& numbers, std::size_t layer) const {
    double sum = 0.0;
    const std::size_t others = isOfLights() ? problem.views.size() : problem.lights.size();
    for (std::size_t i = 0; i < others; ++i)
      sum += isOfLights() ? cost(numbers, i, layer) : cost(numbers, layer, i);
    return sum;
  }

  // By what share a sum falls, at most, when a number is moved a little.
  template <class Cost>
  static double gainOf(float& number, const Cost& sum) {
    const double start = sum();
    const float before = number;
    double gain = 0.0;
    for (const float step : {-0.02f, -0.002f, 0.002f, 0.02f}) {
      number = before + step * std::max(std::abs(before), 0.1f);
      gain = std::max(gain, 1.0 - sum() / start);
    }
    number = before;
    return gain;
  }

  double largestGain(Numbers numbers) const {
    double gain = 0.0;
    for (float& number : numbers.shared) gain = std::max(gain, gainOf(number, [&] { return cost(numbers); }));
    const std::size_t count = problem.model->layerParameters().size();
    for (std::size_t i = 0; i < numbers.layers.size(); ++i)
      gain = std::max(gain, gainOf(numbers.layers[i], [&] { return layerCost(numbers, i / count); }));
    return gain;
  }

  FitProblem problem;
  std::vector<float> targets;  // [view][light]
  std::vector<float> weights;
};

TEST_P(LeastSquaresOfFitters, NoSumIsSmallerNearby) {
  constexpr double kLargest = 0.01;  // solvers end before the last per cent
  EXPECT_LT(largestGain(fit(problem, weights)), kLargest);

  std::vector<float> roots = weights;
  for (float& weight : roots) weight = std::sqrt(weight);
  EXPECT_GT(largestGain(fit(problem, roots)), kLargest) << "weights that are not squared would not be seen";
  EXPECT_GT(largestGain(fit(problem, std::vector<float>(weights.size(), 1.0f))), kLargest) << "likewise";
  FitProblem otherCosine = problem;
  otherCosine.cosineInModel = !problem.cosineInModel;
  EXPECT_GT(largestGain(fit(otherCosine, weights)), kLargest) << "likewise";
}

// But bump, which minimises Cauchy's errors without weights (BumpFitterTest.cpp), and loom and lod,
// whose texels share components (LoomFitterTest.cpp, LodFitterTest.cpp).
std::vector<std::string> fittersOfLeastSquares() {
  std::vector<std::string> names = FitterRegistry::builtin().names();
  std::erase(names, "bump");
  std::erase(names, "loom");
  std::erase(names, "loom_gloss");
  std::erase(names, "lod");
  return names;
}

std::string nameOf(const testing::TestParamInfo<std::tuple<std::string, bool>>& info) {
  return std::get<0>(info.param) + (std::get<1>(info.param) ? "WithTheCosine" : "WithoutTheCosine");
}

INSTANTIATE_TEST_SUITE_P(Models, LeastSquaresOfFitters,
                         testing::Combine(testing::ValuesIn(fittersOfLeastSquares()), testing::Bool()),
                         nameOf);

}  // namespace
}  // namespace weft
