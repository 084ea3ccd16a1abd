#include "weft/fitter/LinearFitter.h"

#include <fmt/format.h>

#include <algorithm>

#include "solvers/LinearLeastSquares.h"

namespace weft {
namespace {

Eigen::MatrixXd termsOf(const FitProblem& problem, const LinearFitter::Terms& terms) {
  std::vector<double> row(problem.model->layerParameters().size());
  Eigen::MatrixXd matrix(problem.lights.size(), row.size());
  for (std::size_t i = 0; i < problem.lights.size(); ++i) {
    terms(problem.lights[i], row);
    const double cosine = problem.cosineInModel ? 1.0 : std::max(double{problem.lights[i].z}, 0.0);
    for (std::size_t k = 0; k < row.size(); ++k)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = cosine * row[k];
  }
  return matrix;
}

}  // namespace

Result<std::unique_ptr<TexelFitter>> LinearFitter::create(const FitProblem& problem, const Terms& terms) {
  std::optional<LinearLeastSquares> solver = LinearLeastSquares::create(termsOf(problem, terms));
  const std::size_t numbers = problem.model->layerParameters().size();
  if (!solver)
    return fail(
        fmt::format("{} directions do not determine the {} numbers that {} has in a layer",
                    problem.lights.size(), numbers, problem.model->description().name),
        {},
        fmt::format("measure at least {} lights (light fields: views), spread over the hemisphere", numbers));
  return std::unique_ptr<TexelFitter>(
      new LinearFitter(std::make_unique<const LinearLeastSquares>(std::move(*solver)), problem.weighted));
}

LinearFitter::LinearFitter(std::unique_ptr<const LinearLeastSquares> solver, bool weighted)
    : solver_(std::move(solver)), weighted_(weighted) {}
LinearFitter::~LinearFitter() = default;

void LinearFitter::fit(std::span<const float> targets, std::span<const float> weights, std::span<float>,
                       std::span<float> layers) const {
  weighted_ ? solver_->solve(targets, weights, layers) : solver_->solve(targets, layers);
}

}  // namespace weft
