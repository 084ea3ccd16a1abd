#include "weft/fitter/LafSolver.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "solvers/LafKernels.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {
// Pairs of directions with equal products.
struct Groups {
  std::vector<std::uint32_t> ofPairs;  // [view][light]
  std::vector<glm::vec3> products;     // a group

  Groups(std::span<const glm::vec3> views, std::span<const glm::vec3> lights) {
    std::map<std::array<long, 3>, std::uint32_t> known;
    for (const glm::vec3 view : views)
      for (const glm::vec3 light : lights) {
        const glm::vec3 product = light * view;
        std::array<long, 3> key;
        for (int i = 0; i < 3; ++i) key[static_cast<std::size_t>(i)] = std::lround(product[i] * 65536.0f);
        const auto [place, isNew] = known.emplace(key, static_cast<std::uint32_t>(products.size()));
        if (isNew) products.push_back(product);
        ofPairs.push_back(place->second);
      }
  }
};

// Lobes that fits are made of at first: axes all over the cube on which the largest is 1.
std::vector<LafLobe> dictionaryOf(float largestExponent) {
  std::vector<glm::vec3> axes;
  const std::array steps{-1.0f, -0.5f, 0.0f, 0.5f, 1.0f};
  for (const float x : steps)
    for (const float y : steps)
      for (const float z : steps)
        if (z == 1.0f || std::max(std::abs(x), std::abs(y)) == 1.0f) axes.emplace_back(x, y, z);
  std::vector<LafLobe> lobes;
  for (const glm::vec3 a : axes)
    for (const float exponent : {1.0f, 3.0f, 8.0f, 20.0f, 50.0f})
      if (exponent <= largestExponent) lobes.push_back({0.0f, a, exponent});
  return lobes;
}

LafTerms termsOf(const LafLobe& lobe) {
  const glm::vec3 unit = glm::normalize(lobe.axes);
  const glm::vec3 other = std::abs(unit.z) < 0.7f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 first = glm::normalize(glm::cross(unit, other));
  return {lobe.amplitude, lobe.exponent, lobe.axes, first, glm::cross(unit, first)};
}

std::vector<LafTerms> termsOf(const LafFit& fit) {
  std::vector<LafTerms> terms;
  for (const LafLobe& lobe : fit.lobes) terms.push_back(termsOf(lobe));
  return terms;
}

AlignedFloats valuesAt(const LafPoints& points, const LafFit& fit) {
  AlignedFloats values(points.x.size());
  lafValues(points, termsOf(fit), fit.diffuse, values);
  return values;
}

// Makes the largest axis 1 without changing the value.
void normalizeAxes(LafLobe& lobe) {
  const float largest = std::max({std::abs(lobe.axes.x), std::abs(lobe.axes.y), lobe.axes.z, 1e-3f});
  lobe.axes /= largest;
  // nothing is left to see of such a lobe but at the horizon
  lobe.axes.z = std::max(lobe.axes.z, -8.0f);
  lobe.amplitude *= std::pow(largest, lobe.exponent);
}

float lowestZ(std::span<const glm::vec3> directions) {
  return std::ranges::min_element(directions, {}, &glm::vec3::z)->z;
}

// Lights down to a height, about 8 degrees apart, as symmetric as the lobes are.
std::vector<glm::vec3> hemisphereGrid(float lowest) {
  std::vector<glm::vec3> grid{{0.0f, 0.0f, 1.0f}};
  for (const double theta : {8.0, 16.0, 24.0, 32.0, 40.0, 48.0, 56.0, 64.0, 70.0, 75.0, 79.0, 83.0, 87.0}) {
    const int quarter = static_cast<int>(std::ceil(std::sin(theta * M_PI / 180.0) * 90.0 / 8.0));
    for (int i = 0; i < 4 * quarter; ++i) {
      const glm::vec3 light = directionFromDegrees(theta, 90.0 * i / quarter);
      if (light.z > lowest - 1e-4f) grid.push_back(light);
    }
  }
  return grid;
}

}  // namespace

// What is computed once for all texels.
struct LafTables {
  LafProblem problem;
  Groups samples;
  LafPoints samplePoints;
  std::vector<LafLobe> dictionary;
  AlignedFloats dictionaryValues;      // [lobe][padded group]
  std::vector<glm::vec3> checkLights;  // where brightness is checked, in every view
  Groups checks;
  LafPoints checkPoints;

  explicit LafTables(LafProblem p);

  // What the model is multiplied by before it is seen.
  float cosine(glm::vec3 light) const { return problem.cosineInModel ? 1.0f : light.z; }
};

LafTables::LafTables(LafProblem p)
    : problem(std::move(p)),
      samples(problem.views, problem.lights),
      samplePoints(samples.products),
      dictionary(dictionaryOf(problem.largestExponent)),
      dictionaryValues(dictionary.size() * samplePoints.x.size()),
      checkLights(hemisphereGrid(problem.cosineInModel ? lowestZ(problem.lights) : 0.0f)),
      checks(problem.views, checkLights),
      checkPoints(checks.products) {
  for (std::size_t k = 0; k < dictionary.size(); ++k)
    for (std::size_t i = 0; i < samples.products.size(); ++i) {
      const float base = std::max(glm::dot(dictionary[k].axes, samples.products[i]), 0.0f);
      const float value = std::pow(base, dictionary[k].exponent);
      // Denormal numbers would slow every search down.
      if (value > 1e-12f) dictionaryValues[k * samplePoints.x.size() + i] = value;
    }
}

namespace {

// Points at which a fit must not exceed a value; where it does, the excess counts as a residual.
struct Ceilings {
  const LafTables& tables;
  std::span<const float> highest;  // of every group of checks
  float weight;

  void addGram(const LafFit& fit, std::span<const LafTerms> terms, std::span<float> gram) const {
    const AlignedFloats values = valuesAt(tables.checkPoints, fit);
    std::vector<glm::vec3> points;
    std::vector<float> limits;
    for (std::size_t i = 0; i < highest.size(); ++i) {
      if (!(values[i] > highest[i])) continue;
      points.push_back(tables.checks.products[i]);
      limits.push_back(weight * highest[i]);
    }
    if (points.empty()) return;
    AlignedFloats scales(points.size());
    AlignedFloats targets(points.size());
    std::fill_n(scales.data(), points.size(), weight);
    std::ranges::copy(limits, targets.data());
    addLafGram({LafPoints(points), scales, targets}, terms, fit.diffuse, gram);
  }
};

// The samples of one texel, merged.
class TexelSolver {
 public:
  TexelSolver(const LafTables& tables, const LafJob& job)
      : tables_(tables), scales_(tables.samples.products.size()), targets_(tables.samples.products.size()) {
    const std::vector<std::uint32_t>& groups = tables.samples.ofPairs;
    std::vector<double> squares(scales_.size(), 0.0);
    std::vector<double> products(scales_.size(), 0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      squares[groups[i]] += double{job.scales[i]} * job.scales[i];
      products[groups[i]] += double{job.scales[i]} * job.targets[i];
      total += double{job.targets[i]} * job.targets[i];
    }
    for (std::size_t k = 0; k < scales_.size(); ++k) {
      if (!(squares[k] > 0.0)) continue;
      scales_[k] = static_cast<float>(std::sqrt(squares[k]));
      targets_[k] = static_cast<float>(products[k] / std::sqrt(squares[k]));
      total -= products[k] * products[k] / squares[k];
      diffuseSquare_ += squares[k];
      diffuseProduct_ += products[k];
    }
    costOfMerging_ = std::max(total, 0.0);
  }

  LafFit diffuseAlone() const {
    LafFit fit;
    if (diffuseSquare_ > 0.0)
      fit.diffuse = static_cast<float>(std::max(diffuseProduct_ / diffuseSquare_, 0.0));
    return fit;
  }

  bool addLobe(LafFit& fit) const;
  void improve(LafFit& fit, int iterations, double tolerance, const Ceilings* ceilings = nullptr) const;
  void replaceLobes(LafFit& fit) const;
  void limit(std::span<const float> ceilings, LafFit& fit) const;

 private:
  static constexpr float kTolerated = 1.03f;  // above the ceilings, after limit()

  static std::vector<double> stepOf(const LafFit& fit, std::span<const float> gram, double damping,
                                    float largestExponent);
  LafFit stepped(const LafFit& fit, std::span<const LafTerms> terms, std::span<const double> step) const;
  struct Excess {
    float factor = 0.0f;
    LafLobe* brightest = nullptr;  // the lobe that gives most there
  };
  Excess excessOf(LafFit& fit, std::span<const float> highest) const;
  std::vector<float> highestValues(std::span<const float> ceilings) const;

  const LafTables& tables_;
  AlignedFloats scales_, targets_;
  double diffuseSquare_ = 0.0, diffuseProduct_ = 0.0;
  double costOfMerging_ = 0.0;  // what even a model that is free for every product leaves
};

// The one that, with the diffuse albedo adapted, explains most of the residuals; false if none
// explains anything.
bool TexelSolver::addLobe(LafFit& fit) const {
  AlignedFloats residuals = valuesAt(tables_.samplePoints, fit);
  for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] = scales_[i] * residuals[i] - targets_[i];
  std::vector<LafCorrelation> sums(tables_.dictionary.size());
  lafCorrelations(scales_, residuals, tables_.dictionaryValues, sums);
  double best = 0.0;
  LafLobe lobe;
  double diffuse = 0.0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double share = sums[k].diffuse / std::max(diffuseSquare_, 1e-30);
    const double square = sums[k].square - share * sums[k].diffuse;
    if (!(sums[k].residual < 0.0f) || !(square > 1e-6 * diffuseSquare_)) continue;
    const double amplitude = -double{sums[k].residual} / square;
    if (amplitude * -double{sums[k].residual} <= best) continue;
    best = amplitude * -double{sums[k].residual};
    lobe = tables_.dictionary[k];
    lobe.amplitude = static_cast<float>(amplitude);
    diffuse = std::max(fit.diffuse - amplitude * share, 0.0);
  }
  if (!(best > 0.0)) return false;
  fit.diffuse = static_cast<float>(diffuse);
  fit.lobes.push_back(lobe);
  return true;
}

// Solves the damped normal equations; unknowns at a bound which they would cross stay where they
// are.
std::vector<double> TexelSolver::stepOf(const LafFit& fit, std::span<const float> gram, double damping,
                                        float largestExponent) {
  const std::size_t unknowns = 4 * fit.lobes.size() + 1;
  const auto size = static_cast<Eigen::Index>(unknowns);
  Eigen::MatrixXd matrix(size, size);
  Eigen::VectorXd right(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) matrix(i, j) = gram[static_cast<std::size_t>(i * (i + 1) / 2 + j)];
    right(i) = -gram[unknowns * (unknowns + 1) / 2 + static_cast<std::size_t>(i)];
  }
  const auto hold = [&](Eigen::Index i) {
    matrix.row(i).head(i).setZero();
    matrix.col(i).tail(size - i - 1).setZero();
    matrix(i, i) = 1.0;
    right(i) = 0.0;
  };
  for (std::size_t j = 0; j < fit.lobes.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(4 * j + 3);
    const float exponent = fit.lobes[j].exponent;
    if ((exponent >= 0.9999f * largestExponent && right(i) > 0.0) || (exponent <= 1.0001f && right(i) < 0.0))
      hold(i);
  }
  if (fit.diffuse <= 0.0f && right(size - 1) < 0.0) hold(size - 1);
  matrix.diagonal() = (1.0 + damping) * matrix.diagonal().array() + 1e-7;
  const Eigen::VectorXd step = matrix.llt().solve(right);
  return {step.begin(), step.end()};
}

LafFit TexelSolver::stepped(const LafFit& fit, std::span<const LafTerms> terms,
                            std::span<const double> step) const {
  // More would be no step but a leap.
  const auto bounded = [](double value, double limit) {
    return static_cast<float>(std::clamp(value, -limit, limit));
  };
  LafFit next = fit;
  for (std::size_t j = 0; j < next.lobes.size(); ++j) {
    LafLobe& lobe = next.lobes[j];
    lobe.amplitude = std::max(lobe.amplitude + static_cast<float>(step[4 * j]), 0.2f * lobe.amplitude);
    lobe.axes +=
        bounded(step[4 * j + 1], 0.5) * terms[j].first + bounded(step[4 * j + 2], 0.5) * terms[j].second;
    lobe.exponent = std::clamp(lobe.exponent * std::exp(bounded(step[4 * j + 3], 1.0)), 1.0f,
                               tables_.problem.largestExponent);
    normalizeAxes(lobe);
  }
  next.diffuse = std::max(fit.diffuse + static_cast<float>(step.back()), 0.0f);
  return next;
}

void TexelSolver::improve(LafFit& fit, int iterations, double tolerance, const Ceilings* ceilings) const {
  std::vector<float> gram;  // of the best fit so far
  std::vector<LafTerms> terms;
  LafFit trial = fit;
  double cost = std::numeric_limits<double>::infinity();
  double damping = 0.07;
  for (int evaluations = 0; evaluations <= iterations && damping < 1e4; ++evaluations) {
    std::vector<LafTerms> trialTerms = termsOf(trial);
    std::vector<float> trialGram(lafGramSize(trial.lobes.size()));
    addLafGram({tables_.samplePoints, scales_, targets_}, trialTerms, trial.diffuse, trialGram);
    if (ceilings) ceilings->addGram(trial, trialTerms, trialGram);
    const double tried = trialGram.back();
    const bool better = tried < cost;
    const bool converged = better && damping < 1.0 && cost - tried < tolerance * tried;
    if (better) {
      cost = tried;
      fit = trial;
      gram = std::move(trialGram);
      terms = std::move(trialTerms);
    }
    if (converged || gram.empty()) break;
    damping = better ? std::max(0.15 * damping, 1e-6) : 5.0 * damping;
    trial = stepped(fit, terms, stepOf(fit, gram, damping, tables_.problem.largestExponent));
  }
  fit.cost = cost + costOfMerging_;
}

void TexelSolver::replaceLobes(LafFit& fit) const {
  for (std::size_t j = 0; j < fit.lobes.size(); ++j) {
    LafFit other = fit;
    other.lobes.erase(other.lobes.begin() + static_cast<std::ptrdiff_t>(j));
    improve(other, 3, 1e-3);
    if (!addLobe(other)) continue;
    improve(other, 10, 1e-3);
    if (other.cost < 0.999 * fit.cost) fit = std::move(other);
  }
}

// Of every group of checks, what the model may be.
std::vector<float> TexelSolver::highestValues(std::span<const float> ceilings) const {
  std::vector<float> highest(tables_.checks.products.size(), std::numeric_limits<float>::infinity());
  std::size_t pair = 0;
  for (const float ceiling : ceilings)
    for (const glm::vec3 light : tables_.checkLights) {
      float& value = highest[tables_.checks.ofPairs[pair++]];
      value = std::min(value, ceiling / tables_.cosine(light));
    }
  return highest;
}

// Where the model exceeds its highest values most.
TexelSolver::Excess TexelSolver::excessOf(LafFit& fit, std::span<const float> highest) const {
  const AlignedFloats values = valuesAt(tables_.checkPoints, fit);
  Excess excess;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < highest.size(); ++i)
    if (values[i] > excess.factor * highest[i]) {
      excess.factor = values[i] / std::max(highest[i], 1e-12f);
      worst = i;
    }
  float most = 0.0f;
  for (LafLobe& lobe : fit.lobes) {
    const float base = std::max(glm::dot(lobe.axes, tables_.checks.products[worst]), 0.0f);
    const float value = lobe.amplitude * std::pow(base, lobe.exponent);
    if (value <= most) continue;
    most = value;
    excess.brightest = &lobe;
  }
  return excess;
}

void TexelSolver::limit(std::span<const float> ceilings, LafFit& fit) const {
  const std::vector<float> highest = highestValues(ceilings);
  // Excess at one point weighs as much as a thirtieth of all samples.
  const Ceilings active{tables_, highest, static_cast<float>(std::sqrt(0.03 * diffuseSquare_))};
  if (excessOf(fit, highest).factor <= 1.0f) return;
  for (std::size_t attempt = 0; attempt <= fit.lobes.size(); ++attempt) {
    improve(fit, 30, 1e-4, &active);
    const Excess excess = excessOf(fit, highest);
    if (excess.factor < 1.2f || !excess.brightest) break;
    // A spike that does not find its way out: without it the others do, and it grows again if it is
    // needed.
    excess.brightest->amplitude = 0.0f;
  }
  const float scale = std::min(kTolerated / excessOf(fit, highest).factor, 1.0f);
  fit.diffuse *= scale;
  for (LafLobe& lobe : fit.lobes) lobe.amplitude *= scale;
  improve(fit, 0, 0.0);  // the cost without the ceilings
}

}  // namespace

LafSolver::LafSolver(LafProblem problem) : tables_(std::make_unique<LafTables>(std::move(problem))) {}
LafSolver::~LafSolver() = default;

LafFit LafSolver::fit(const LafJob& job, int lobes) const {
  const TexelSolver texel(*tables_, job);
  LafFit fit = texel.diffuseAlone();
  const auto count = static_cast<std::size_t>(lobes);
  while (fit.lobes.size() < count && texel.addLobe(fit)) texel.improve(fit, 8, 1e-3);
  texel.replaceLobes(fit);
  texel.improve(fit, 30, 1e-5);
  if (!std::isfinite(fit.cost)) fit = LafFit();
  fit.lobes.resize(count);
  return fit;
}

void LafSolver::improve(const LafJob& job, int iterations, LafFit& fit) const {
  TexelSolver(*tables_, job).improve(fit, iterations, 1e-5);
}

void LafSolver::limit(const LafJob& job, std::span<const float> ceilings, LafFit& fit) const {
  TexelSolver(*tables_, job).limit(ceilings, fit);
}

std::vector<float> LafSolver::values(const LafFit& fit) const {
  const AlignedFloats values = valuesAt(tables_->samplePoints, fit);
  std::vector<float> result;
  for (const std::uint32_t group : tables_->samples.ofPairs) result.push_back(values[group]);
  return result;
}

std::vector<float> LafSolver::peaks(const LafFit& fit) const {
  const AlignedFloats values = valuesAt(tables_->checkPoints, fit);
  std::vector<float> result;
  std::size_t pair = 0;
  for (std::size_t view = 0; view < tables_->problem.views.size(); ++view) {
    float peak = 0.0f;
    for (const glm::vec3 light : tables_->checkLights)
      peak = std::max(peak, values[tables_->checks.ofPairs[pair++]] * tables_->cosine(light));
    result.push_back(peak);
  }
  return result;
}

std::span<const std::uint32_t> LafSolver::groups() const {
  return tables_->samples.ofPairs;
}

std::size_t LafSolver::groupCount() const {
  return tables_->samples.products.size();
}

}  // namespace weft
