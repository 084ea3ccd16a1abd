#include "models/BumpFitter.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "solvers/LightSpacing.h"
#include "weft/core/Contract.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

constexpr std::size_t kFewestLights = 6;
// Parabolic coordinates of normals stay within: 60 degrees from the pole. What is steeper is hardly
// seen.
constexpr float kSteepest = 0.577f;

std::vector<std::size_t> aboveHorizon(const std::vector<glm::vec3>& lights) {
  std::vector<std::size_t> above;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].z > 0.0f) above.push_back(i);
  return above;
}

bool spanSpace(const std::vector<glm::vec3>& lights, const std::vector<std::size_t>& chosen) {
  constexpr double kFlattest = 0.01;  // of singular values, the smallest by the largest
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
  for (const std::size_t i : chosen) {
    const Eigen::Vector3d light(lights[i].x, lights[i].y, lights[i].z);
    gram += light * light.transpose();
  }
  const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
                                      .computeDirect(gram, Eigen::EigenvaluesOnly)
                                      .eigenvalues();
  return squares[0] > kFlattest * kFlattest * squares[2];
}

// Cauchy's: the squares of errors below `scale`; shadows and highlights, far above it, hardly
// count.
float costOf(const Eigen::ArrayXf& errors, float scale) {
  return (errors / scale).square().log1p().sum();
}

}  // namespace

// Albedo, parabolic normal and roughness, as they are stored.
struct BumpFitter::Surface {
  Eigen::Vector4f numbers{0.0f, 0.0f, 0.0f, 1.0f};
  float cost = std::numeric_limits<float>::infinity();
};

Result<std::unique_ptr<TexelFitter>> BumpFitter::create(const FitProblem& problem) {
  WEFT_EXPECT(problem.cosineInModel, "bump contains n.l");
  const std::vector<std::size_t> above = aboveHorizon(problem.lights);
  if (above.size() < kFewestLights)
    return fail(
        fmt::format("{} lights above the horizon do not determine a normal, an albedo and a roughness",
                    above.size()),
        {}, fmt::format("measure at least {} lights", kFewestLights));
  if (!spanSpace(problem.lights, above))
    return fail("the lights are in one plane with the surface, so they do not determine its normal", {},
                "measure lights all around");
  return std::unique_ptr<TexelFitter>(new BumpFitter(problem));
}

BumpFitter::BumpFitter(const FitProblem& problem)
    : model_(problem.model), lightCount_(problem.lights.size()), index_(aboveHorizon(problem.lights)) {
  for (std::size_t i : index_) lights_.push_back(problem.lights[i]);
  view_ = static_cast<std::size_t>(std::ranges::max_element(problem.views, {}, &glm::vec3::z) -
                                   problem.views.begin());
  viewDirection_ = problem.views[view_];
  // Half vectors move by half the angle that lights move by, which makes the exponent about four
  // times as large; GGX of this alpha is about as wide (Walter 2007).
  smoothest_ = std::sqrt(std::sqrt(2.0f / (4.0f * sharpestExponent(lights_) + 2.0f)));
}

Eigen::ArrayXf BumpFitter::valuesOf(const Eigen::Vector4f& numbers) const {
  Eigen::ArrayXf values(static_cast<Eigen::Index>(lights_.size()));
  for (std::size_t i = 0; i < lights_.size(); ++i)
    values[static_cast<Eigen::Index>(i)] =
        model_->evaluate({numbers.data(), 4}, {}, lights_[i], viewDirection_);
  return values;
}

Eigen::Vector4f BumpFitter::bounded(Eigen::Vector4f numbers, float brightest) const {
  numbers[0] = std::clamp(numbers[0], 0.0f, 4.0f * brightest);
  const float slope = numbers.segment<2>(1).norm();
  if (slope > kSteepest) numbers.segment<2>(1) *= kSteepest / slope;
  numbers[3] = std::clamp(numbers[3], smoothest_, 1.0f);
  return numbers;
}

// The plane through the samples of middling brightness.
BumpFitter::Surface BumpFitter::lambertian(const Eigen::ArrayXf& samples) const {
  std::vector<Eigen::Index> order(lights_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return samples[i]; });
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t rank = order.size() * 4 / 10; rank < (order.size() * 95 + 99) / 100; ++rank) {
    const glm::vec3 light = lights_[static_cast<std::size_t>(order[rank])];
    const Eigen::Vector3d l(light.x, light.y, light.z);
    normal += l * l.transpose();
    right += double{samples[order[rank]]} * l;
  }
  const Eigen::Vector3f n = normal.ldlt().solve(right).cast<float>();
  Surface surface;
  surface.numbers[0] = n.norm();
  if (n.z() > 0.0f) surface.numbers.segment<2>(1) = n.head<2>() / (n.norm() + n.z());
  return surface;
}

// Gauss-Newton steps with damping. The scale of Cauchy's errors shrinks from step to step, because
// a small one has many local minima.
BumpFitter::Surface BumpFitter::improved(const Eigen::ArrayXf& samples, Surface surface, ScaleRange scales,
                                         int iterations) const {
  const float brightest = samples.maxCoeff();
  float scale = scales.first;
  Eigen::ArrayXf values = valuesOf(surface.numbers);
  float damping = 1e-3f;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Eigen::MatrixX4f slopes(values.size(), 4);
    for (Eigen::Index k = 0; k < 4; ++k) {
      Eigen::Vector4f moved = surface.numbers;
      const float step = k == 3 && moved[k] > 0.5f ? -2e-3f : 2e-3f;  // roughness is bounded
      moved[k] += step;
      slopes.col(k) = (valuesOf(moved) - values) / step;
    }
    const Eigen::ArrayXf errors = samples - values;
    const Eigen::ArrayXf weights = (errors.square() + scale * scale).inverse();
    const Eigen::Matrix4f normal = slopes.transpose() * weights.matrix().asDiagonal() * slopes;
    const Eigen::Vector4f right = slopes.transpose() * (weights * errors).matrix();
    Eigen::Matrix4f damped = normal;
    damped.diagonal() += damping * (normal.diagonal().array() + 1e-6f).matrix();
    const Eigen::Vector4f numbers = bounded(surface.numbers + damped.ldlt().solve(right), brightest);
    const Eigen::ArrayXf candidate = valuesOf(numbers);
    if (costOf(samples - candidate, scale) < costOf(errors, scale)) {
      surface.numbers = numbers;
      values = candidate;
      damping = std::max(0.1f * damping, 1e-6f);
    } else {
      damping *= 10.0f;
    }
    scale = std::max(0.75f * scale, scales.last);
  }
  surface.cost = costOf(samples - values, scales.last);
  return surface;
}

// Without the weights of a display, which are largest in shadows.
void BumpFitter::fit(std::span<const float> targets, std::span<const float>, std::span<float> shared,
                     std::span<float>) const {
  Eigen::ArrayXf samples(static_cast<Eigen::Index>(index_.size()));
  for (std::size_t i = 0; i < index_.size(); ++i)
    samples[static_cast<Eigen::Index>(i)] = targets[view_ * lightCount_ + index_[i]];
  const float brightest = samples.maxCoeff();
  Surface best = lambertian(samples);
  const Eigen::Vector4f flat = bounded(best.numbers, brightest);
  if (flat[0] > 0.0f) {
    for (float roughness : {smoothest_, 0.6f, 1.0f}) {
      const Surface rough = improved(samples, {{flat[0], flat[1], flat[2], roughness}},
                                     {0.2f * brightest, 0.05f * brightest}, 6);
      if (rough.cost < best.cost) best = rough;
    }
    best = improved(samples, best, {0.05f * brightest, 0.02f * brightest}, 15);
  }
  std::ranges::copy(best.numbers, shared.begin());
}

}  // namespace weft
