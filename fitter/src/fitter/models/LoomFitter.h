#pragma once

#include <memory>
#include <optional>

#include "solvers/GlossSolver.h"
#include "solvers/TrainingTexels.h"
#include "solvers/ViewRegistration.h"
#include "solvers/WeightedLeastSquares.h"
#include "weft/fitter/FieldFitter.h"
#include "weft/fitter/TexelFitter.h"
#include "weft/reflectance/LoomModel.h"

namespace weft {

/// Fits `loom`: a pass that registers the views, one that finds the components from some texels,
/// and then the weights of each texel by themselves, rounded to what a GPU keeps of them. Of
/// `loom_gloss` the lobe of a texel is found first, and the rest is fitted to what it leaves.
class LoomFitter : public FieldFitter {
 public:
  static Result<std::unique_ptr<FieldFitter>> create(const FitProblem& problem);
  explicit LoomFitter(const FitProblem& problem);

  int gatheringPasses() const override { return 2; }
  void gather(int pass, TexelRun& texels, std::vector<double>& ofRow) const override;
  Result<void> endPass(int pass, std::span<const std::vector<double>> ofRows) override;
  std::vector<glm::ivec2> registration() const override { return shifts_.offsets; }
  FieldTables tables() const override { return tables_; }
  int texelsAtOnce() const override { return WeightedLeastSquares::kSetsAtOnce; }
  void fit(TexelRun& texels, RunParameters& parameters) const override;
  std::vector<FieldLevel> levels(FieldLevel finest) const override;

 private:
  /// Part of the field in which the views are registered.
  struct Window {
    int x = 0, y = 0, width = 0, height = 0;
    bool contains(int column, int row) const {
      return column >= x && column < x + width && row >= y && row < y + height;
    }
  };

  std::size_t pairs() const { return problem_.views.size() * problem_.lights.size(); }
  void gatherWindow(TexelRun& texels, std::vector<double>& ofRow) const;
  void gatherTraining(TexelRun& texels, std::vector<double>& ofRow) const;
  void registerWindow(std::span<const std::vector<double>> ofRows);
  Result<void> findComponents(std::span<const std::vector<double>> ofRows);
  bool hasGloss() const { return firstWeight_ > 3; }
  Result<void> setGloss(std::span<const float> values);
  void removeGloss(std::span<glm::vec3> samples, std::span<float> values) const;
  FloatImage registrationTable() const;
  FloatImage lightMaps(std::span<const float> basis, std::span<const float> hue) const;
  void setTerms(std::shared_ptr<const ReflectanceModel> bound);
  std::span<const glm::vec3> valuesOf(const TexelSamples& samples) const;
  float squaredWeight(float value) const;
  glm::vec3 baseColor(std::span<const glm::vec3> samples, std::span<const float> gloss,
                      std::span<const float> weights) const;

  FitProblem problem_;
  std::size_t components_;
  std::size_t firstWeight_;  ///< LoomModel's
  Window window_;
  std::vector<std::size_t> windowLights_;
  TrainingTexels training_;
  ViewShifts shifts_;
  FieldTables tables_;
  std::vector<float> terms_;  ///< `[pair][component]`, n.l included, as the model gives them
  std::vector<float> hues_;   ///< `[pair][red0, red1, blue0, blue1]`, likewise
  std::optional<WeightedLeastSquares> solver_;
  std::optional<GlossSolver> glossSolver_;
  std::vector<double> gram_;  ///< of the terms, as a display weighs them: what levels are judged by
};

}  // namespace weft
