#include "solvers/GlossSolver.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "FitWeights.h"
#include "weft/core/Contract.h"
#include "weft/core/CpuVersions.h"
#include "weft/core/HemisphereTriangulation.h"

namespace weft {
namespace {

constexpr std::size_t kFewestDirections = 12;
// What the dictionary has; alpha and tilts between are found from the nearest. Half vectors of
// lights 15 degrees apart are 7.5 degrees apart: sharper lobes hide between them. Wider ones than
// kRoughest are as smooth as what components hold.
constexpr float kAlphas[] = {0.16f, 0.26f, 0.42f};
constexpr float kTiltStep = 0.1f;
constexpr float kSharpest = 0.15f, kRoughest = 0.5f;
// Of the squares of the residuals of a texel, what a lobe has to explain.
constexpr float kLeastShare = 0.04f;
constexpr std::size_t kResidualsOfShape = 384;
constexpr float kLowestLight = 0.05f;

// Each direction between the others.
Result<std::vector<DirectionWeights>> betweenOthers(const std::vector<glm::vec3>& directions) {
  std::vector<DirectionWeights> between;
  for (std::size_t left = 0; left < directions.size(); ++left) {
    std::vector<glm::vec3> others = directions;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    WEFT_TRY(const auto triangulation, HemisphereTriangulation::create(others));
    DirectionWeights weights = triangulation.locate(directions[left]);
    for (int& index : weights.index)
      if (index >= static_cast<int>(left)) ++index;
    between.push_back(weights);
  }
  return between;
}

// `[set][sample]` times a vector, one product a set.
WEFT_CPU_VERSIONS
void productsOf(const float* sets, std::size_t count, std::size_t samples, const float* vector,
                float* products) {
  for (std::size_t set = 0; set < count; ++set) {
    const float* of = sets + set * samples;
    float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = 0; i < samples; ++i) sum += of[i] * vector[i];
    products[set] = sum;
  }
}

template <class Residuals>
void applyResiduals(const Residuals& residuals, const float* values, std::span<float> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& residual = residuals[i];
    out[i] = residual.factor[0] * values[residual.pair[0]] + residual.factor[1] * values[residual.pair[1]] +
             residual.factor[2] * values[residual.pair[2]] + residual.factor[3] * values[residual.pair[3]];
  }
}

GlossLobe boundedLobe(GlossLobe lobe) {
  if (const float length = std::hypot(lobe.tilt.x, lobe.tilt.y); length > GlossLobe::kSteepest)
    lobe.tilt *= GlossLobe::kSteepest / length;
  lobe.alpha = std::clamp(lobe.alpha, kSharpest, kRoughest);
  return lobe;
}

}  // namespace

// A lobe with the amount that leaves least, and what it leaves.
struct GlossSolver::Fit {
  GlossLobe lobe;
  Eigen::VectorXf unit;  ///< the residuals of an amount of 1
  float cost = 0.0f;
};

Result<GlossSolver> GlossSolver::create(std::span<const glm::vec3> views, std::span<const glm::vec3> lights,
                                        std::span<const float> typical) {
  if (views.size() < kFewestDirections || lights.size() < kFewestDirections)
    return fail("there are too few views or lights for a lobe of gloss");
  GlossSolver solver(views, lights);
  WEFT_TRY_VOID(solver.addResiduals(typical));
  constexpr float kEnd = GlossLobe::kSteepest + 0.5f * kTiltStep;
  for (const float alpha : kAlphas)
    for (float y = -GlossLobe::kSteepest; y < kEnd; y += kTiltStep)
      for (float x = -GlossLobe::kSteepest; x < kEnd; x += kTiltStep)
        if (std::hypot(x, y) <= GlossLobe::kSteepest) solver.addShape({{x, y}, alpha, 1.0f});
  return solver;
}

Result<void> GlossSolver::addResiduals(std::span<const float> typical) {
  WEFT_TRY(const std::vector<DirectionWeights> ofLights, betweenOthers(lights_));
  WEFT_TRY(const std::vector<DirectionWeights> ofViews, betweenOthers(views_));
  const auto lights = static_cast<std::uint32_t>(lights_.size());
  for (const bool betweenLights : {true, false})
    for (std::uint32_t view = 0; view < views_.size(); ++view)
      for (std::uint32_t light = 0; light < lights; ++light) {
        const std::uint32_t pair = view * lights + light;
        const float weight = displayWeight(typical[pair]);
        const DirectionWeights& between = betweenLights ? ofLights[light] : ofViews[view];
        Residual residual{{pair}, {weight}};
        for (int k = 0; k < 3; ++k) {
          const auto other = static_cast<std::uint32_t>(between.index[static_cast<std::size_t>(k)]);
          residual.pair[k + 1] = betweenLights ? view * lights + other : other * lights + light;
          // interpolated without n.l
          const float cosines =
              betweenLights ? lights_[light].z / std::max(lights_[other].z, kLowestLight) : 1.0f;
          residual.factor[k + 1] = -weight * between.weight[k] * cosines;
        }
        residuals_.push_back(residual);
      }
  return {};
}

void GlossSolver::addShape(const GlossLobe& lobe) {
  const std::vector<float> values = valuesOf(lobe);
  std::vector<float> residuals(residuals_.size());
  applyResiduals(residuals_, values.data(), residuals);
  const float squares = std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0f);
  if (!(squares > 0.0f)) return;
  const std::size_t first = matches_.size();
  matches_.resize(first + pairs());
  for (std::size_t i = 0; i < residuals.size(); ++i)
    for (std::size_t k = 0; k < kTaps; ++k)
      matches_[first + residuals_[i].pair[k]] += residuals_[i].factor[k] * residuals[i] / std::sqrt(squares);

  Shape shape{lobe, std::vector<std::uint32_t>(residuals.size()), {}, {}};
  std::iota(shape.residuals.begin(), shape.residuals.end(), 0u);
  std::ranges::stable_sort(shape.residuals, std::greater(),
                           [&](std::uint32_t i) { return std::abs(residuals[i]); });
  shape.residuals.resize(std::min(kResidualsOfShape, residuals.size()));
  std::vector<std::uint32_t> placeOf(pairs(), ~0u);
  for (const std::uint32_t i : shape.residuals) {
    Residual local = residuals_[i];
    for (std::uint32_t& pair : local.pair) {
      std::uint32_t& place = placeOf[pair];
      if (place == ~0u) {
        place = static_cast<std::uint32_t>(shape.pairs.size());
        shape.pairs.push_back(pair);
      }
      pair = place;
    }
    shape.ofPairs.push_back(local);
  }
  shapes_.push_back(std::move(shape));
}

float GlossSolver::valueOf(const GlossLobe& lobe, std::size_t pair) const {
  const glm::vec3 light = lights_[pair % lights_.size()];
  return light.z * lobe.evaluate(light, views_[pair / lights_.size()]);
}

std::vector<float> GlossSolver::valuesOf(const GlossLobe& lobe) const {
  std::vector<float> values(pairs());
  for (std::size_t pair = 0; pair < values.size(); ++pair) values[pair] = valueOf(lobe, pair);
  return values;
}

GlossSolver::Fit GlossSolver::fitAmount(const GlossLobe& lobe, const Shape& where,
                                        std::span<const float> targets) const {
  std::vector<float> values;
  GlossLobe unit = lobe;
  unit.amount = 1.0f;
  for (const std::uint32_t pair : where.pairs) values.push_back(valueOf(unit, pair));
  Fit fit{unit, Eigen::VectorXf(static_cast<Eigen::Index>(targets.size())), 0.0f};
  applyResiduals(where.ofPairs, values.data(), {fit.unit.data(), targets.size()});
  const Eigen::Map<const Eigen::VectorXf> target(targets.data(), fit.unit.size());
  const float squares = fit.unit.squaredNorm();
  fit.lobe.amount = squares > 0.0f ? std::clamp(fit.unit.dot(target) / squares, 0.0f, 1.0f) : 0.0f;
  fit.cost = (target - fit.lobe.amount * fit.unit).squaredNorm();
  return fit;
}

// Gauss-Newton steps with damping, where the lobe of the dictionary is large.
GlossLobe GlossSolver::fittedLobe(std::span<const float> residuals, const Shape& from) const {
  constexpr int kSteps = 6;
  std::vector<float> targets;
  for (const std::uint32_t i : from.residuals) targets.push_back(residuals[i]);
  const Eigen::Map<const Eigen::VectorXf> target(targets.data(), static_cast<Eigen::Index>(targets.size()));
  Fit best = fitAmount(from.lobe, from, targets);
  float damping = 1e-3f;
  for (int step = 0; step < kSteps && best.lobe.amount > 0.0f; ++step) {
    Eigen::MatrixX4f slopes(target.size(), 4);
    slopes.col(0) = best.unit;
    const float moves[] = {0.01f, 0.01f, -0.05f * best.lobe.alpha};
    for (int k = 0; k < 3; ++k) {
      GlossLobe moved = best.lobe;
      (k < 2 ? moved.tilt[k] : moved.alpha) += moves[k];
      slopes.col(k + 1) = best.lobe.amount / moves[k] * (fitAmount(moved, from, targets).unit - best.unit);
    }
    Eigen::Matrix4f normal = slopes.transpose() * slopes;
    normal.diagonal() *= 1.0f + damping;
    const Eigen::Vector4f change =
        normal.ldlt().solve(slopes.transpose() * (target - best.lobe.amount * best.unit));
    if (!change.allFinite()) break;
    GlossLobe moved = best.lobe;
    moved.tilt += glm::vec2(change[1], change[2]);
    moved.alpha += change[3];
    Fit candidate = fitAmount(boundedLobe(moved), from, targets);
    if (candidate.cost < best.cost) {
      best = std::move(candidate);
      damping = std::max(0.1f * damping, 1e-6f);
    } else {
      damping *= 10.0f;
    }
  }
  return best.lobe;
}

std::vector<GlossLobe> GlossSolver::solve(std::span<const float> values) const {
  const std::size_t texels = values.size() / pairs();
  WEFT_EXPECT(values.size() == texels * pairs(), "texels have all pairs");
  std::vector<float> products(shapes_.size() * texels);
  for (std::size_t shape = 0; shape < shapes_.size(); ++shape)
    productsOf(values.data(), texels, pairs(), matches_.data() + shape * pairs(),
               products.data() + shape * texels);
  std::vector<GlossLobe> lobes(texels);
  std::vector<float> residuals(residuals_.size());
  for (std::size_t texel = 0; texel < texels; ++texel) {
    applyResiduals(residuals_, values.data() + texel * pairs(), residuals);
    const float squares = std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0f);
    std::size_t best = 0;
    float largest = 0.0f;
    for (std::size_t shape = 0; shape < shapes_.size(); ++shape)
      if (const float product = products[shape * texels + texel]; product > largest)
        largest = product, best = shape;
    if (largest * largest > kLeastShare * squares)
      lobes[texel] = fittedLobe(residuals, shapes_[best]).rounded();
  }
  return lobes;
}

}  // namespace weft
