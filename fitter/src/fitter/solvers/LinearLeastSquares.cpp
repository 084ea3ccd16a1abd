#include "solvers/LinearLeastSquares.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "weft/core/Contract.h"

namespace weft {
namespace {

// `normals`: a column a set, the lower triangle of its normal matrix by rows.
template <int Unknowns>
void solveNormals(const Eigen::MatrixXf& normals, const Eigen::MatrixXf& rights,
                  Eigen::Map<Eigen::MatrixXf> solutions) {
  const Eigen::Index unknowns = rights.rows();
  Eigen::Matrix<double, Unknowns, Unknowns> normal(unknowns, unknowns);
  for (Eigen::Index set = 0; set < rights.cols(); ++set) {
    for (Eigen::Index i = 0, next = 0; i < unknowns; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) normal(i, j) = normals(next++, set);
    const Eigen::Matrix<double, Unknowns, 1> right = rights.col(set).cast<double>();
    solutions.col(set) =
        normal.template selfadjointView<Eigen::Lower>().ldlt().solve(right).template cast<float>();
  }
}

Eigen::Map<const Eigen::MatrixXf> columnsOf(std::span<const float> values, Eigen::Index rows) {
  WEFT_EXPECT(values.size() % static_cast<std::size_t>(rows) == 0, "every set has all samples");
  return {values.data(), rows, static_cast<Eigen::Index>(values.size()) / rows};
}

Eigen::Map<Eigen::MatrixXf> columnsFor(std::span<float> solutions, Eigen::Index unknowns, Eigen::Index sets) {
  WEFT_EXPECT(solutions.size() == static_cast<std::size_t>(unknowns * sets), "every set has a solution");
  return {solutions.data(), unknowns, sets};
}

}  // namespace

std::optional<LinearLeastSquares> LinearLeastSquares::create(const Eigen::MatrixXd& terms) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(terms);
  decomposition.setThreshold(1e-4);
  if (decomposition.rank() < terms.cols()) return std::nullopt;
  return LinearLeastSquares(terms);
}

LinearLeastSquares::LinearLeastSquares(const Eigen::MatrixXd& terms)
    : terms_(terms.transpose().cast<float>()),
      products_(terms.cols() * (terms.cols() + 1) / 2, terms.rows()) {
  for (Eigen::Index i = 0, next = 0; i < terms.cols(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      products_.row(next++) = terms.col(i).cwiseProduct(terms.col(j)).transpose().cast<float>();
  pseudoInverse_ = terms.completeOrthogonalDecomposition().pseudoInverse().cast<float>();
}

void LinearLeastSquares::solve(std::span<const float> targets, std::span<const float> weights,
                               std::span<float> solutions) const {
  const auto samples = columnsOf(targets, terms_.cols());
  const auto factors = columnsOf(weights, terms_.cols());
  WEFT_EXPECT(samples.cols() == factors.cols(), "every sample has a weight");
  const Eigen::MatrixXf squares = factors.cwiseAbs2();
  const Eigen::MatrixXf normals = products_ * squares;
  const Eigen::MatrixXf rights = terms_ * squares.cwiseProduct(samples);
  const auto results = columnsFor(solutions, terms_.rows(), samples.cols());
  // of biquadratic polynomials: Eigen is much faster with a size that it knows
  if (terms_.rows() == 6)
    solveNormals<6>(normals, rights, results);
  else
    solveNormals<Eigen::Dynamic>(normals, rights, results);
}

void LinearLeastSquares::solve(std::span<const float> targets, std::span<float> solutions) const {
  const auto samples = columnsOf(targets, terms_.cols());
  columnsFor(solutions, terms_.rows(), samples.cols()).noalias() = pseudoInverse_ * samples;
}

}  // namespace weft
