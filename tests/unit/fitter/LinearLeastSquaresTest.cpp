#include "solvers/LinearLeastSquares.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

namespace weft {
namespace {

constexpr Eigen::Index kSamples = 30;

Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, double low, double high) {
  static std::mt19937 random(5);
  std::uniform_real_distribution<double> distribution(low, high);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return distribution(random); });
}

std::span<const float> floatsOf(const Eigen::MatrixXf& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

class LinearLeastSquaresTest : public testing::TestWithParam<Eigen::Index> {};

// Weights are squared, and each set has its own.
TEST_P(LinearLeastSquaresTest, IsThatOfAHouseholderDecomposition) {
  const Eigen::MatrixXd terms = randomMatrix(kSamples, GetParam(), -1, 1);
  const Eigen::MatrixXf targets = randomMatrix(kSamples, 4, 0, 1).cast<float>();
  const Eigen::MatrixXf weights = randomMatrix(kSamples, 4, 0.1, 3).cast<float>();
  Eigen::MatrixXf solutions(GetParam(), 4);
  const auto solver = LinearLeastSquares::create(terms);
  ASSERT_TRUE(solver);
  const std::span<float> out(solutions.data(), static_cast<std::size_t>(solutions.size()));
  solver->solve(floatsOf(targets), floatsOf(weights), out);
  for (Eigen::Index set = 0; set < 4; ++set) {
    const auto w = weights.col(set).cast<double>().asDiagonal();
    const Eigen::VectorXd expected =
        (w * terms).colPivHouseholderQr().solve(w * targets.col(set).cast<double>());
    EXPECT_LT((solutions.col(set).cast<double>() - expected).norm(), 1e-5) << set;
  }
  solver->solve(floatsOf(targets), out);
  const Eigen::MatrixXd expected = terms.colPivHouseholderQr().solve(targets.cast<double>());
  EXPECT_LT((solutions.cast<double>() - expected).norm(), 1e-5);
}

TEST_P(LinearLeastSquaresTest, SetsWithoutWeightAreFinite) {
  const auto solver = LinearLeastSquares::create(randomMatrix(kSamples, GetParam(), -1, 1));
  ASSERT_TRUE(solver);
  Eigen::VectorXf solution(GetParam());
  solver->solve(floatsOf(Eigen::VectorXf::Ones(kSamples)), floatsOf(Eigen::VectorXf::Zero(kSamples)),
                {solution.data(), static_cast<std::size_t>(solution.size())});
  EXPECT_TRUE(solution.allFinite());
}

// 6 is solved with a fixed size.
INSTANTIATE_TEST_SUITE_P(Unknowns, LinearLeastSquaresTest, testing::Values(1, 6, 9, 16));

TEST(LinearLeastSquares, SamplesThatDoNotDetermineTheUnknownsAreRefused) {
  EXPECT_FALSE(LinearLeastSquares::create(randomMatrix(5, 6, -1, 1)));
  Eigen::MatrixXd terms = randomMatrix(kSamples, 4, -1, 1);
  terms.col(3) = terms.col(1) - 2.0 * terms.col(0);
  EXPECT_FALSE(LinearLeastSquares::create(terms));
}

}  // namespace
}  // namespace weft
