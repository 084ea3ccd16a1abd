#include "solvers/WeightedLeastSquares.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>
#include <tuple>
#include <vector>

namespace weft {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Matrix randomFloats(std::size_t rows, std::size_t columns, float low, float high) {
  static std::mt19937 random(7);
  std::uniform_real_distribution<float> distribution(low, high);
  return Matrix::NullaryExpr(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns),
                             [&] { return distribution(random); });
}

std::span<const float> spanOf(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

Matrix solved(const Matrix& terms, const Matrix& values, const Matrix& squares) {
  const WeightedLeastSquares solver(spanOf(terms), static_cast<std::size_t>(terms.cols()));
  Matrix solutions = Matrix::Constant(values.rows(), terms.cols(), -7.0f);
  solver.solve(spanOf(values), spanOf(squares),
               {solutions.data(), static_cast<std::size_t>(solutions.size())});
  return solutions;
}

// Samples, unknowns and sets that fill no chunk, tile or vector, and some that do.
using Sizes = std::tuple<std::size_t, std::size_t, std::size_t>;
class WeightedLeastSquaresTest : public testing::TestWithParam<Sizes> {};

TEST_P(WeightedLeastSquaresTest, IsThatOfAHouseholderDecomposition) {
  const auto [samples, unknowns, sets] = GetParam();
  const Matrix terms = randomFloats(samples, unknowns, -1, 1);
  const Matrix values = randomFloats(sets, samples, 0, 1);
  const Matrix squares = randomFloats(sets, samples, 0.05f, 9);
  const Matrix solutions = solved(terms, values, squares);
  for (Eigen::Index set = 0; set < solutions.rows(); ++set) {
    const Eigen::VectorXd w = squares.row(set).cast<double>().cwiseSqrt();
    const Eigen::VectorXd target = w.cwiseProduct(values.row(set).transpose().cast<double>());
    const Eigen::VectorXd expected =
        (w.asDiagonal() * terms.cast<double>()).colPivHouseholderQr().solve(target);
    EXPECT_LT((solutions.row(set).transpose().cast<double>() - expected).norm(), 1e-4 * (1 + expected.norm()))
        << set;
  }
}

TEST_P(WeightedLeastSquaresTest, FindsTheFactorsOfAProduct) {
  const auto [samples, unknowns, sets] = GetParam();
  const Matrix terms = randomFloats(samples, unknowns, -1, 1);
  const Matrix factors = randomFloats(sets, unknowns, -1, 1);
  const Matrix values = factors * terms.transpose();
  const Matrix found = solved(terms, values, randomFloats(sets, samples, 0.05f, 9));
  EXPECT_LT((found - factors).cwiseAbs().maxCoeff(), 1e-3f);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WeightedLeastSquaresTest,
                         testing::Values(Sizes{300, 1, 3}, Sizes{256, 4, 32}, Sizes{777, 16, 33},
                                         Sizes{1000, 48, 9}, Sizes{640, 13, 70}));

TEST(WeightedLeastSquares, SetsWithoutWeightOrLightAreZero) {
  const Matrix terms = randomFloats(500, 16, -1, 1);
  Matrix squares = randomFloats(3, 500, 1, 100);
  Matrix values = randomFloats(3, 500, 0, 1);
  squares.row(0).setZero();
  values.row(1).setZero();
  const Matrix solutions = solved(terms, values, squares);
  EXPECT_TRUE(solutions.topRows(2).isZero(0.0f));
  EXPECT_GT(solutions.row(2).norm(), 0.01f);
}

TEST(WeightedLeastSquares, UnknownsWithoutTermsAreZero) {
  Matrix terms = randomFloats(500, 8, -1, 1);
  terms.rightCols(3).setZero();
  const Matrix values = randomFloats(4, 500, 0, 1);
  const Matrix squares = randomFloats(4, 500, 1, 100);
  const Matrix solutions = solved(terms, values, squares);
  EXPECT_TRUE(solutions.rightCols(3).isZero(0.0f));
  EXPECT_LT((solutions.leftCols(5) - solved(terms.leftCols(5), values, squares)).cwiseAbs().maxCoeff(),
            1e-6f);
}

TEST(WeightedLeastSquares, FewSamplesAreReproducedByBoundedSolutions) {
  const Matrix terms = randomFloats(500, 16, -1, 1);
  const Matrix values = randomFloats(2, 500, 0, 1);
  Matrix squares = Matrix::Zero(2, 500);
  squares.leftCols(5).setConstant(50.0f);  // fewer samples than unknowns
  const Matrix solutions = solved(terms, values, squares);
  const Matrix shown = solutions * terms.transpose();
  EXPECT_LT((shown - values).leftCols(5).cwiseAbs().maxCoeff(), 1e-2f);
  EXPECT_LT(solutions.cwiseAbs().maxCoeff(), 10.0f);
}

// Two equal terms share what one of them would have.
TEST(WeightedLeastSquares, DependentTermsGiveBoundedSolutions) {
  Matrix terms = randomFloats(500, 6, -1, 1);
  terms.col(4) = terms.col(1);
  const Matrix values = randomFloats(2, 500, 0, 1);
  const Matrix solutions = solved(terms, values, Matrix::Ones(2, 500));
  EXPECT_TRUE(solutions.allFinite());
  EXPECT_LT(solutions.cwiseAbs().maxCoeff(), 2.0f);
}

TEST(WeightedLeastSquares, ASetDoesNotDependOnTheOthers) {
  const Matrix terms = randomFloats(500, 20, -1, 1);
  const Matrix values = randomFloats(40, 500, 0, 1);
  const Matrix squares = randomFloats(40, 500, 1, 100);
  const Matrix together = solved(terms, values, squares);
  for (Eigen::Index set : {0, 31, 32, 39})
    EXPECT_EQ(solved(terms, values.row(set), squares.row(set)), together.row(set));
}

TEST(WeightedLeastSquares, ProjectsByTheTerms) {
  const Matrix terms = randomFloats(500, 20, -1, 1);
  const Matrix values = randomFloats(40, 500, 0, 1);
  Matrix products(40, 20);
  WeightedLeastSquares(spanOf(terms), 20)
      .project(spanOf(values), {products.data(), static_cast<std::size_t>(products.size())});
  EXPECT_LT((products - values * terms).cwiseAbs().maxCoeff(), 1e-4f);
}

}  // namespace
}  // namespace weft
