#include "solvers/ComponentBasis.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/SVD>
#include <cmath>
#include <random>

#include "FitWeights.h"
#include "solvers/WeightedLeastSquares.h"

namespace weft {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::span<const float> floatsOf(const Rows& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

// A sum of products of positive numbers, weaker ones later, with a little noise.
Rows someTexels(Eigen::Index texels, Eigen::Index pairs, Eigen::Index rank, float noise) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const auto draw = [&](Eigen::Index rows, Eigen::Index columns) {
    return Rows(Rows::NullaryExpr(rows, columns, [&] { return unit(random); }));
  };
  Rows weights = draw(texels, rank);
  for (Eigen::Index k = 0; k < rank; ++k) weights.col(k) *= 0.5f / static_cast<float>(1 + k);
  return weights * draw(rank, pairs) + noise * draw(texels, pairs);
}

Rows basisOf(const Rows& values, std::size_t components) {
  const std::vector<float> basis =
      fitComponentBasis(floatsOf(values), static_cast<std::size_t>(values.cols()), components);
  return Eigen::Map<const Rows>(basis.data(), values.cols(), static_cast<Eigen::Index>(components));
}

std::vector<float> squaredWeights(const Rows& values) {
  std::vector<float> weights = displayWeights(floatsOf(values));
  for (float& weight : weights) weight *= weight;
  return weights;
}

Rows weightsOf(const Rows& values, const Rows& basis) {
  Rows weights(values.rows(), basis.cols());
  WeightedLeastSquares(floatsOf(basis), static_cast<std::size_t>(basis.cols()))
      .solve(floatsOf(values), squaredWeights(values),
             {weights.data(), static_cast<std::size_t>(weights.size())});
  return weights;
}

// The mean squared residual as a display shows it.
float displayedError(const Rows& values, const Rows& basis) {
  const Rows residuals = values - weightsOf(values, basis) * basis.transpose();
  const std::vector<float> squares = squaredWeights(values);
  float sum = 0.0f;
  for (std::size_t i = 0; i < squares.size(); ++i) sum += squares[i] * std::pow(residuals.data()[i], 2.0f);
  return sum / static_cast<float>(squares.size());
}

TEST(ComponentBasis, ReproducesAProductOfAsManyComponents) {
  const Rows values = someTexels(300, 200, 8, 0.0f);
  EXPECT_LT(displayedError(values, basisOf(values, 8)), 1e-8f);
}

// Dark pairs and texels count as much as a display shows them.
TEST(ComponentBasis, LooksCloserThanAnUnweightedDecomposition) {
  Rows values = someTexels(300, 200, 20, 0.02f);
  for (Eigen::Index i = 0; i < values.cols(); ++i) values.col(i) *= std::pow(0.98f, static_cast<float>(i));
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values.row(i) *= 20.0f * std::pow(0.98f, static_cast<float>(i));
  const Eigen::JacobiSVD<Eigen::MatrixXf> svd(values, Eigen::ComputeThinV);
  EXPECT_LT(displayedError(values, basisOf(values, 8)),
            0.97f * displayedError(values, svd.matrixV().leftCols(8)));
}

TEST(ComponentBasis, StrongestIsFirstAndWeightsAreNormalised) {
  const Rows values = someTexels(500, 200, 8, 0.01f);
  const Rows basis = basisOf(values, 8);
  const Rows weights = weightsOf(values, basis);
  const Rows correlation = weights.transpose() * weights / static_cast<float>(weights.rows());
  EXPECT_LT((correlation - Rows::Identity(8, 8)).cwiseAbs().maxCoeff(), 0.03f);
  for (Eigen::Index k = 1; k < basis.cols(); ++k)
    EXPECT_GT(basis.col(k - 1).norm(), 0.9f * basis.col(k).norm());
}

TEST(ComponentBasis, MoreComponentsThanTexelsOrPairsAreZero) {
  for (const auto& [texels, pairs] : {std::pair{5, 200}, {300, 6}, {1, 1}}) {
    const Rows values = someTexels(texels, pairs, 4, 0.1f);
    const Rows basis = basisOf(values, 16);
    EXPECT_TRUE(basis.allFinite());
    EXPECT_TRUE(basis.rightCols(16 - std::min(texels, pairs)).isZero(0.0f));
    EXPECT_LT(displayedError(values, basis), 1e-6f);
  }
}

TEST(ComponentBasis, BlackTexelsHaveNoComponents) {
  EXPECT_TRUE(basisOf(Rows::Zero(40, 30), 8).isZero(0.0f));
}

TEST(ComponentBasis, DoesNotDependOnTheNumberOfThreads) {
  const Rows values = someTexels(300, 200, 20, 0.02f);
  const Rows basis = basisOf(values, 12);
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(basisOf(values, 12), basis);
}

}  // namespace
}  // namespace weft
