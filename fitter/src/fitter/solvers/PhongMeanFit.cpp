#include "solvers/PhongMeanFit.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {
namespace {

/// The formula is linear but for the exponent: the other numbers, and what is left over.
class MeanProblem {
 public:
  MeanProblem(std::span<const glm::vec3> views, std::span<const glm::vec3> lights,
              std::span<const double> values, std::span<const double> squaredWeights,
              std::span<const double> factors)
      : terms_(static_cast<Eigen::Index>(values.size()), 3),
        scales_(terms_.rows()),
        targets_(terms_.rows()),
        halves_(terms_.rows()) {
    for (std::size_t pair = 0; pair < values.size(); ++pair) {
      const glm::vec3 view = views[pair / lights.size()], light = lights[pair % lights.size()];
      const auto row = static_cast<Eigen::Index>(pair);
      const double weight = std::sqrt(squaredWeights[pair]);
      scales_[row] = weight * factors[pair];
      targets_[row] = weight * values[pair];
      terms_.row(row) << scales_[row], scales_[row] * double{light.z}, 0.0;
      halves_[row] = double{(light + view).z} / std::max(double{glm::length(light + view)}, 1e-6);
    }
  }

  /// The sum of squares that is left, and the numbers.
  double solve(double exponent, Eigen::Vector3d& numbers) {
    terms_.col(2) = scales_.array() * halves_.array().max(0.0).pow(exponent);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-6);
    numbers = decomposition.compute(terms_).solve(targets_);
    return (terms_ * numbers - targets_).squaredNorm();
  }

 private:
  Eigen::Matrix<double, Eigen::Dynamic, 3> terms_;
  Eigen::VectorXd scales_, targets_, halves_;
};

}  // namespace

PhongMean fitPhongMean(std::span<const glm::vec3> views, std::span<const glm::vec3> lights,
                       std::span<const double> values, std::span<const double> squaredWeights,
                       std::span<const double> factors, float sharpest) {
  constexpr int kSteps = 40;
  MeanProblem problem(views, lights, values, squaredWeights, factors);
  const double last = std::log(std::max(double{sharpest}, 1.0));
  PhongMean best;
  double least = INFINITY;
  for (int step = 0; step <= kSteps; ++step) {
    const double exponent = std::exp(last * step / kSteps);
    Eigen::Vector3d numbers;
    const double left = problem.solve(exponent, numbers);
    // The blunter of two that are as good.
    if (!(left < (1.0 - 1e-9) * least)) continue;
    least = left;
    best = {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2]),
            static_cast<float>(exponent)};
  }
  return best;
}

}  // namespace weft
