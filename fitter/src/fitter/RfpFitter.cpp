#include "RfpFitter.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>

namespace weft {

Result<std::unique_ptr<TexelFitter>> RfpFitter::create(const FitProblem& problem) {
  Basis basis(problem.lights.size(), 6);
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const glm::dvec3 l = problem.lights[static_cast<std::size_t>(i)];
    basis.row(i) << l.x * l.x, l.y * l.y, l.x * l.y, l.x, l.y, 1.0;
    if (!problem.cosineInModel) basis.row(i) *= l.z;
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(basis);
  svd.setThreshold(1e-4);
  if (svd.rank() < 6)
    return fail("the lights do not determine the six coefficients of rfp", {},
                "measure at least six lights, spread over the hemisphere");
  return std::unique_ptr<TexelFitter>(new RfpFitter(std::move(basis)));
}

void RfpFitter::fit(std::span<const float> targets, std::span<const float> weights, std::span<float>,
                    std::span<float> layers) const {
  const auto lights = static_cast<std::size_t>(basis_.rows());
  for (std::size_t view = 0; view * lights < targets.size(); ++view) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < lights; ++i) {
      const auto row = basis_.row(static_cast<Eigen::Index>(i));
      const double squared = double{weights[view * lights + i]} * weights[view * lights + i];
      normal.noalias() += squared * row.transpose() * row;
      right += squared * targets[view * lights + i] * row.transpose();
    }
    const Eigen::Matrix<double, 6, 1> coefficients = normal.ldlt().solve(right);
    for (std::size_t k = 0; k < 6; ++k)
      layers[view * 6 + k] = static_cast<float>(coefficients(static_cast<Eigen::Index>(k)));
  }
}

}  // namespace weft
