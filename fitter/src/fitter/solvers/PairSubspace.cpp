#include "solvers/PairSubspace.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <random>

namespace weft {
namespace {

using Values = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

constexpr Eigen::Index kAtOnce = 256;

// Calls of(first, count) for pieces of a range, in parallel: the same for any number of threads.
template <class Function>
void forPieces(Eigen::Index size, const Function& of) {
  tbb::parallel_for(Eigen::Index{0}, (size + kAtOnce - 1) / kAtOnce, [&](Eigen::Index piece) {
    of(piece * kAtOnce, std::min(kAtOnce, size - piece * kAtOnce));
  });
}

Eigen::MatrixXf times(const Values& values, const Eigen::MatrixXf& ofPairs) {
  Eigen::MatrixXf product(values.rows(), ofPairs.cols());
  forPieces(values.rows(), [&](Eigen::Index first, Eigen::Index count) {
    product.middleRows(first, count).noalias() = values.middleRows(first, count) * ofPairs;
  });
  return product;
}

Eigen::MatrixXf transposedTimes(const Values& values, const Eigen::MatrixXf& ofTexels) {
  Eigen::MatrixXf product(values.cols(), ofTexels.cols());
  forPieces(values.cols(), [&](Eigen::Index first, Eigen::Index count) {
    product.middleRows(first, count).noalias() = values.middleCols(first, count).transpose() * ofTexels;
  });
  return product;
}

Eigen::MatrixXf orthonormalColumns(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> decomposition(columns);
  return decomposition.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

Eigen::MatrixXf randomColumns(Eigen::Index rows, Eigen::Index columns) {
  // Its numbers are the same everywhere, those of distributions are not.
  std::mt19937 random(2005);
  return Eigen::MatrixXf::NullaryExpr(rows, columns,
                                      [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; });
}

}  // namespace

Eigen::MatrixXf pairSubspace(std::span<const float> numbers, std::span<const float> first, std::size_t most) {
  constexpr int kIterations = 2;
  const auto pairs = static_cast<Eigen::Index>(first.size());
  const Values values(numbers.data(), static_cast<Eigen::Index>(numbers.size()) / pairs, pairs);
  const Eigen::Index count = std::min({static_cast<Eigen::Index>(most), values.rows(), pairs});
  Eigen::MatrixXf ofPairs = randomColumns(pairs, count);
  for (int iteration = 0; iteration < kIterations; ++iteration)
    ofPairs = orthonormalColumns(transposedTimes(values, orthonormalColumns(times(values, ofPairs))));
  Eigen::MatrixXf all(pairs, std::min(count + 1, pairs));
  all.col(0) = Eigen::Map<const Eigen::VectorXf>(first.data(), pairs);
  all.rightCols(all.cols() - 1) = ofPairs.leftCols(all.cols() - 1);
  return orthonormalColumns(all);
}

Eigen::MatrixXd strongestEigenvectors(const Eigen::MatrixXd& matrix, std::size_t count) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  const Eigen::VectorXd& values = solver.eigenvalues();
  Eigen::MatrixXd strongest = Eigen::MatrixXd::Zero(matrix.rows(), static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < std::min(strongest.cols(), matrix.rows()); ++k) {
    const Eigen::Index from = matrix.rows() - 1 - k;
    if (values[from] > 1e-10 * values[matrix.rows() - 1]) strongest.col(k) = solver.eigenvectors().col(from);
  }
  return strongest;
}

}  // namespace weft
