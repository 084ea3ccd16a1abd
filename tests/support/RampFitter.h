#pragma once

#include <algorithm>
#include <cmath>

#include "RampModel.h"
#include "weft/core/Color.h"
#include "weft/fitter/FitterRegistry.h"

namespace weft::test {

/// Fits RampModel: the first pass looks for the largest value of all texels, up to which the table
/// then rises evenly; the second finds each view's place in it.
class RampFitter : public FieldFitter {
 public:
  /// Weft's fitters and this one.
  static FitterRegistry registry() {
    FitterRegistry fitters = FitterRegistry::builtin();
    fitters.add("ramp", [](const FitProblem& problem) -> Result<std::unique_ptr<FieldFitter>> {
      return std::make_unique<RampFitter>(problem);
    });
    return fitters;
  }

  explicit RampFitter(const FitProblem& problem) : views_(problem.views.size()) {
    const int power = problem.model->options().number("power") + (problem.cosineInModel ? 0 : 1);
    for (const glm::vec3 light : problem.lights)
      slopes_.push_back(static_cast<float>(std::pow(light.z, power)));
  }

  int gatheringPasses() const override { return 1; }

  void gather(int, TexelRun& texels, std::vector<double>& ofRow) const override {
    ofRow.resize(1);
    for (int i = 0; i < texels.size(); ++i)
      for (std::size_t view = 0; view < views_; ++view)
        ofRow[0] = std::max<double>(ofRow[0], valueOf(texels.fitted(i), view));
  }

  Result<void> endPass(int, std::span<const std::vector<double>> ofRows) override {
    for (const std::vector<double>& row : ofRows) largest_ = std::max(largest_, static_cast<float>(row[0]));
    if (largest_ > 0.0f) return {};
    return fail("all of the measurement is black");
  }

  FieldTables tables() const override {
    FloatImage ramp(5, 1, {"value"});
    for (int x = 0; x < 5; ++x) ramp.at(x, 0, 0) = 0.25f * static_cast<float>(x) * largest_;
    return {{"ramp", ramp}};
  }

  void fit(TexelRun& texels, RunParameters& parameters) const override {
    for (int i = 0; i < texels.size(); ++i) {
      std::ranges::fill(parameters.shared(i), 1.0f);  // the base colour
      for (std::size_t view = 0; view < views_; ++view)
        parameters.layers(i)[view] = valueOf(texels.fitted(i), view) / largest_;
    }
  }

 private:
  // By which the power of n.l is multiplied to come closest to a view's luminance.
  float valueOf(const TexelSamples& samples, std::size_t view) const {
    float products = 0.0f, squares = 0.0f;
    for (std::size_t light = 0; light < slopes_.size(); ++light) {
      products += slopes_[light] * luminance(samples.linear[view * slopes_.size() + light]);
      squares += slopes_[light] * slopes_[light];
    }
    return std::max(products / squares, 0.0f);
  }

  std::size_t views_;
  std::vector<float> slopes_;
  float largest_ = 0.0f;
};

}  // namespace weft::test
