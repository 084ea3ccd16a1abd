#include "models/RfpFitter.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "models/ExchangedFitter.h"

namespace weft {
namespace {

constexpr Eigen::Index kUnknowns = 6;

Eigen::MatrixXd basisOf(const FitProblem& problem) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(problem.lights.size()), kUnknowns);
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const glm::dvec3 l = problem.lights[static_cast<std::size_t>(i)];
    basis.row(i) << l.x * l.x, l.y * l.y, l.x * l.y, l.x, l.y, 1.0;
    if (!problem.cosineInModel) basis.row(i) *= std::max(l.z, 0.0);
  }
  return basis;
}

}  // namespace

Result<std::unique_ptr<TexelFitter>> RfpFitter::create(const FitProblem& problem) {
  const Eigen::MatrixXd basis = basisOf(problem);
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(basis);
  svd.setThreshold(1e-4);
  if (svd.rank() < kUnknowns)
    return fail("the directions do not determine the six coefficients of a polynomial", {},
                "measure at least six lights (lfp: views), spread over the hemisphere");
  return std::unique_ptr<TexelFitter>(new RfpFitter(basis, problem.weighted));
}

Result<std::unique_ptr<TexelFitter>> RfpFitter::createForLights(const FitProblem& problem) {
  return ExchangedFitter::create(problem, RfpFitter::create);
}

Result<std::unique_ptr<TexelFitter>> RfpFitter::createForOneView(const FitProblem& problem) {
  if (problem.views.size() != 1)
    return fail(
        fmt::format("a polynomial texture map is of one view, this measurement has {}", problem.views.size()),
        {}, "fit rfp, which is one for every view");
  return create(problem);
}

RfpFitter::RfpFitter(const Eigen::MatrixXd& basis, bool weighted)
    : basis_(basis.transpose().cast<float>()), products_(21, basis.rows()), weighted_(weighted) {
  for (Eigen::Index i = 0, next = 0; i < kUnknowns; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      products_.row(next++) = basis.col(i).cwiseProduct(basis.col(j)).transpose().cast<float>();
  pseudoInverse_ = basis.completeOrthogonalDecomposition().pseudoInverse().cast<float>();
}

void RfpFitter::fit(std::span<const float> targets, std::span<const float> weights, std::span<float>,
                    std::span<float> layers) const {
  const Eigen::Index lights = basis_.cols();
  const Eigen::Index views = static_cast<Eigen::Index>(targets.size()) / lights;
  const Eigen::Map<const Eigen::MatrixXf> samples(targets.data(), lights, views);
  Eigen::Map<Basis> coefficients(layers.data(), kUnknowns, views);
  if (!weighted_) {
    coefficients.noalias() = pseudoInverse_ * samples;
    return;
  }
  const Eigen::MatrixXf squares =
      Eigen::Map<const Eigen::MatrixXf>(weights.data(), lights, views).cwiseAbs2();
  const Eigen::MatrixXf normals = products_ * squares;
  const Eigen::MatrixXf rights = basis_ * squares.cwiseProduct(samples);
  for (Eigen::Index view = 0; view < views; ++view) {
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
    for (Eigen::Index i = 0, next = 0; i < kUnknowns; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) normal(i, j) = normals(next++, view);
    coefficients.col(view) =
        normal.selfadjointView<Eigen::Lower>().ldlt().solve(rights.col(view).cast<double>()).cast<float>();
  }
}

}  // namespace weft
