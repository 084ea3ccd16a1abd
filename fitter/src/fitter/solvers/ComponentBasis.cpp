#include "solvers/ComponentBasis.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "FitWeights.h"
#include "solvers/WeightedLeastSquares.h"
#include "weft/core/Contract.h"

namespace weft {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::span<const float> floatsOf(const Rows& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

// The values of some texels and pairs, read by texels or by pairs.
class Samples {
 public:
  Samples(std::span<const float> values, std::size_t pairs)
      : values_(values.data(), static_cast<Eigen::Index>(values.size() / pairs),
                static_cast<Eigen::Index>(pairs)) {}

  Eigen::Index texels() const { return values_.rows(); }
  Eigen::Index pairs() const { return values_.cols(); }
  Eigen::VectorXd pairMeans() const {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(pairs());
    for (Eigen::Index texel = 0; texel < texels(); ++texel)
      sums += values_.row(texel).transpose().cast<double>();
    return sums / static_cast<double>(texels());
  }

  // For every texel, or every pair, a row of sums over the other of `terms` times values.
  Rows projectTexels(const Rows& terms) const { return overSets(false, terms, false); }
  Rows projectPairs(const Rows& terms) const { return overSets(true, terms, false); }
  // The factors of `terms` that come closest, likewise.
  Rows fitTexels(const Rows& terms) const { return overSets(false, terms, true); }
  Rows fitPairs(const Rows& terms) const { return overSets(true, terms, true); }

 private:
  Rows overSets(bool ofPairs, const Rows& terms, bool fitted) const {
    const WeightedLeastSquares solver(floatsOf(terms), static_cast<std::size_t>(terms.cols()));
    Rows results(ofPairs ? pairs() : texels(), terms.cols());
    constexpr Eigen::Index atOnce = 4 * WeightedLeastSquares::kSetsAtOnce;
    tbb::parallel_for(Eigen::Index{0}, (results.rows() + atOnce - 1) / atOnce, [&](Eigen::Index block) {
      const Eigen::Index first = block * atOnce;
      const Eigen::Index count = std::min(atOnce, results.rows() - first);
      const Rows values = ofPairs ? ofPairsFrom(first, count) : Rows(values_.middleRows(first, count));
      const std::span<float> out(results.row(first).data(), static_cast<std::size_t>(count * results.cols()));
      if (fitted)
        solver.solve(floatsOf(values), squaredDisplayWeights(values), out);
      else
        solver.project(floatsOf(values), out);
    });
    return results;
  }

  // A row a pair. Texel by texel: each lies on pages of its own.
  Rows ofPairsFrom(Eigen::Index first, Eigen::Index count) const {
    Rows transposed(count, texels());
    for (Eigen::Index texel = 0; texel < texels(); ++texel)
      for (Eigen::Index i = 0; i < count; ++i) transposed(i, texel) = values_(texel, first + i);
    return transposed;
  }

  static std::vector<float> squaredDisplayWeights(const Rows& values) {
    std::vector<float> weights = displayWeights(floatsOf(values));
    for (float& weight : weights) weight *= weight;
    return weights;
  }

  Eigen::Map<const Rows> values_;
};

Rows randomRows(Eigen::Index rows, Eigen::Index columns) {
  // Its numbers are the same everywhere, those of distributions are not.
  std::mt19937 random(20031);
  return Rows::NullaryExpr(rows, columns,
                           [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; });
}

Rows orthonormal(const Rows& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> decomposition(columns);
  return decomposition.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

// The eigenvectors of a symmetric matrix, those of the largest eigenvalue first, and these.
struct SortedEigen {
  Eigen::MatrixXd vectors;
  Eigen::VectorXd values;

  explicit SortedEigen(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    vectors = solver.eigenvectors().rowwise().reverse();
    values = solver.eigenvalues().reverse().cwiseMax(0.0);
  }
};

// The weights of texels that a SVD of pairs, scaled, gives.
Rows firstWeights(const Samples& samples, const Eigen::VectorXf& scales, Eigen::Index components) {
  constexpr Eigen::Index extra = 8;  // what randomised subspaces need beyond the rank
  constexpr int kIterations = 4;
  const Eigen::Index count = std::min({components + extra, samples.texels(), samples.pairs()});
  Rows ofPairs = randomRows(samples.pairs(), count);
  Rows ofTexels;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    ofTexels = orthonormal(samples.projectTexels(scales.asDiagonal() * ofPairs));
    ofPairs = scales.asDiagonal() * samples.projectPairs(ofTexels);
    if (iteration < kIterations - 1) ofPairs = orthonormal(ofPairs);
  }
  const Eigen::MatrixXd gram = ofPairs.cast<double>().transpose() * ofPairs.cast<double>();
  const SortedEigen eigen(gram);
  return ofTexels * eigen.vectors.leftCols(std::min(components, count)).cast<float>();
}

// The same products of components and weights, with the strongest first and weights of root mean
// square 1 without correlation.
Rows ordered(const Rows& basis, const Rows& weights, const Eigen::VectorXf& scales) {
  const Eigen::MatrixXd ofWeights = weights.cast<double>().transpose() * weights.cast<double>();
  const SortedEigen root(ofWeights / static_cast<double>(weights.rows()));
  const Eigen::MatrixXd spread = root.vectors * root.values.cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd scaled = (scales.asDiagonal() * basis).cast<double>() * spread;
  const SortedEigen strengths(scaled.transpose() * scaled);
  Rows result = (basis.cast<double>() * (spread * strengths.vectors)).cast<float>();
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    if (!(strengths.values[k] > 1e-12 * strengths.values[0])) result.col(k).setZero();
  return result;
}

}  // namespace

std::vector<float> fitComponentBasis(std::span<const float> values, std::size_t pairs,
                                     std::size_t components) {
  WEFT_EXPECT(pairs > 0 && !values.empty() && values.size() % pairs == 0, "every texel has all pairs");
  const Samples samples(values, pairs);
  const Eigen::VectorXf scales =
      samples.pairMeans()
          .unaryExpr([](double mean) { return displayWeight(static_cast<float>(mean)); })
          .cast<float>();

  Rows weights = firstWeights(samples, scales, static_cast<Eigen::Index>(components));
  Rows basis = samples.fitPairs(weights);
  weights = samples.fitTexels(basis);
  basis = ordered(samples.fitPairs(weights), weights, scales);

  std::vector<float> result(pairs * components, 0.0f);
  Eigen::Map<Rows>(result.data(), basis.rows(), static_cast<Eigen::Index>(components))
      .leftCols(basis.cols()) = basis;
  return result;
}

}  // namespace weft
