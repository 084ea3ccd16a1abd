#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "solvers/LaplacianPyramid.h"
#include "solvers/PhongMeanFit.h"
#include "solvers/TrainingTexels.h"
#include "solvers/WeightedLeastSquares.h"
#include "weft/fitter/FieldFitter.h"
#include "weft/fitter/TexelFitter.h"
#include "weft/reflectance/LodModel.h"

namespace weft {

/// Fits `lod`, in values scaled by a weight of each pair, as a display weighs its mean.
///
/// All steps of [Ma 2005] are linear in the values, so they are made in few *coordinates* a texel
/// instead of all pairs: a first pass finds the subspace in which nearly all of the values lie,
/// from some texels, and the mean; a second finds the coordinates of each texel. Their pyramid is
/// that of the images, and the principal components of its levels are those of the images' levels.
class LodFitter : public FieldFitter {
 public:
  static Result<std::unique_ptr<FieldFitter>> create(const FitProblem& problem);
  explicit LodFitter(const FitProblem& problem);

  int gatheringPasses() const override { return 2; }
  void gather(int pass, TexelRun& texels, std::vector<double>& ofRow) const override;
  Result<void> endPass(int pass, std::span<const std::vector<double>> ofRows) override;
  FieldTables tables() const override { return tables_; }
  int texelsAtOnce() const override { return WeightedLeastSquares::kSetsAtOnce; }
  void fit(TexelRun& texels, RunParameters& parameters) const override;
  std::vector<FieldLevel> levels(FieldLevel finest) const override;

 private:
  /// Y, Cb or Cr.
  struct Channel {
    std::size_t components = 0;       ///< of a level
    std::size_t firstComponent = 0;   ///< among those of all channels
    std::vector<float> mean{};        ///< a pair each, n.l included
    Eigen::MatrixXf basis{};          ///< of the subspace, a row a pair
    std::size_t firstCoordinate = 0;  ///< among those of all channels
    std::optional<WeightedLeastSquares> projector{};
    std::size_t coordinates() const { return static_cast<std::size_t>(basis.cols()); }
  };

  std::size_t pairs() const { return problem_.views.size() * problem_.lights.size(); }
  float cosineOf(std::size_t pair) const;
  std::span<const glm::vec3> valuesOf(const TexelSamples& samples) const;
  void gatherTraining(TexelRun& texels, std::vector<double>& ofRow) const;
  void gatherCoordinates(TexelRun& texels, std::vector<double>& ofRow) const;
  void findSubspace(std::span<const std::vector<double>> ofRows);
  void findMeans(std::span<const std::vector<double>> ofRows);
  std::vector<float> trainingOf(int channel, std::span<const std::vector<double>> ofRows) const;
  NumberImage coordinateImage(std::span<const std::vector<double>> ofRows) const;
  void makeLevels(const NumberImage& coordinates);
  void makeLevel(std::size_t level, const NumberImage& residual, NumberImage& shown);
  void makeComponents(std::size_t level, const Channel& channel, const NumberImage& residual,
                      NumberImage& shown);
  void makeTables();
  FloatImage eigenBrdfTable() const;
  FloatImage meanPolynomialTable() const;

  FitProblem problem_;
  TrainingTexels training_;
  std::vector<float> scales_;  ///< of the pairs
  std::array<Channel, 3> channels_;
  PhongMean phong_;
  std::array<float, 2> chroma_{};  ///< the mean Cb and Cr
  std::vector<FloatImage> levels_;
  std::vector<Eigen::MatrixXf> eigenBrdfs_;  ///< of each level: a row a pair, a column a component
  FieldTables tables_;
};

}  // namespace weft
