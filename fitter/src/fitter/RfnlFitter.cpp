#include "RfnlFitter.h"

#include <ceres/tiny_solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "FitWeights.h"
#include "weft/core/Direction.h"
#include "weft/reflectance/RfnlModel.h"

namespace weft {
namespace {

// The samples of one texel in one view, and what is known of them.
struct ViewSamples {
  std::span<const float> luminance;
  std::span<const double> weights;
  const std::vector<glm::dvec3>& lights;
  const std::vector<double>& cosines;
};

// A lobe as the solver sees it: four numbers without bounds. amplitude = root^2; the direction in parabolic
// coordinates; exponent = largest^sigmoid(bend), between 1 and the largest that is allowed.
struct Lobe {
  double root = 0.0;
  double px = 0.0, py = 0.0;
  double bend = 0.0;

  double amplitude() const { return root * root; }
  double exponent(double largest) const { return std::pow(largest, 1.0 / (1.0 + std::exp(-bend))); }

  static Lobe from(double amplitude, glm::dvec3 direction, double exponent, double largest) {
    const double share = std::clamp(std::log(exponent) / std::log(largest), 0.02, 0.98);
    const double z = std::max(direction.z, -0.5);
    return {std::sqrt(std::max(amplitude, 1e-6)), direction.x / (1.0 + z), direction.y / (1.0 + z),
            std::log(share / (1.0 - share))};
  }
};

// One view's parameters: K lobes, then the root of the diffuse albedo.
template <int K>
using Parameters = Eigen::Matrix<double, 4 * K + 1, 1>;

// Weighted residuals and their derivatives for ceres::TinySolver. The diffuse albedo is solved for or held.
template <int K, bool SolveDiffuse>
struct ViewResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 4 * K + (SolveDiffuse ? 1 : 0) };

  const ViewSamples& samples;
  double largestExponent;
  double diffuse;  // where it is held

  int NumResiduals() const { return static_cast<int>(samples.luminance.size()); }

  bool operator()(const double* p, double* residuals, double* jacobian) const {
    const std::size_t count = samples.luminance.size();
    for (std::size_t i = 0; i < count; ++i) {
      const double scale = samples.weights[i] * samples.cosines[i];
      const double rhoD = SolveDiffuse ? p[4 * K] * p[4 * K] : diffuse;
      residuals[i] = scale * rhoD - samples.weights[i] * samples.luminance[i];
      if (SolveDiffuse && jacobian)
        jacobian[static_cast<std::size_t>(4 * K) * count + i] = scale * 2.0 * p[4 * K];
    }
    for (int j = 0; j < K; ++j)
      addLobe(p + 4 * j, residuals, jacobian ? jacobian + 4 * j * static_cast<int>(count) : nullptr);
    return true;
  }

 private:
  void addLobe(const double* p, double* residuals, double* jacobian) const {
    const std::size_t count = samples.luminance.size();
    const double squared = p[1] * p[1] + p[2] * p[2];
    const double inverse = 1.0 / (1.0 + squared);
    const glm::dvec3 m = glm::dvec3(2.0 * p[1], 2.0 * p[2], 1.0 - squared) * inverse;
    const glm::dvec3 byX = (glm::dvec3(2.0, 0.0, -2.0 * p[1]) - 2.0 * p[1] * m) * inverse;
    const glm::dvec3 byY = (glm::dvec3(0.0, 2.0, -2.0 * p[2]) - 2.0 * p[2] * m) * inverse;
    const double sigmoid = 1.0 / (1.0 + std::exp(-p[3]));
    const double logLargest = std::log(largestExponent);
    const double exponent = std::exp(logLargest * sigmoid);
    const double exponentByBend = exponent * logLargest * sigmoid * (1.0 - sigmoid);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 l = samples.lights[i];
      const double dot = glm::dot(m, l);
      const double scale = samples.weights[i] * samples.cosines[i];
      const double logDot = dot > 1e-9 ? std::log(dot) : 0.0;
      const double power = dot > 1e-9 ? scale * std::exp(exponent * logDot) : 0.0;
      const double value = p[0] * p[0] * power;
      residuals[i] += value;
      if (!jacobian) continue;
      const double byDot = dot > 1e-9 ? exponent * value / dot : 0.0;
      jacobian[i] = 2.0 * p[0] * power;
      jacobian[count + i] = byDot * glm::dot(byX, l);
      jacobian[2 * count + i] = byDot * glm::dot(byY, l);
      jacobian[3 * count + i] = value * logDot * exponentByBend;
    }
  }
};

// What the lobes alone give for every light, without weights.
template <int K>
std::vector<double> lobesOf(const Parameters<K>& p, const ViewSamples& samples, double largestExponent) {
  const std::vector<double> ones(samples.luminance.size(), 1.0);
  const std::vector<float> black(samples.luminance.size(), 0.0f);
  const ViewSamples unweighted{black, ones, samples.lights, samples.cosines};
  std::vector<double> values(samples.luminance.size());
  ViewResiduals<K, false>{unweighted, largestExponent, 0.0}(p.data(), values.data(), nullptr);
  return values;
}

// Improves `p` from where it is; returns half the sum of squares.
template <int K, bool SolveDiffuse>
double improve(const ViewSamples& samples, double largestExponent, int iterations, Parameters<K>& p) {
  using Residuals = ViewResiduals<K, SolveDiffuse>;
  const Residuals residuals{samples, largestExponent, p[4 * K] * p[4 * K]};
  thread_local ceres::TinySolver<Residuals> solver;
  solver.options.max_num_iterations = iterations;
  solver.options.parameter_tolerance = 1e-5;
  solver.options.initial_trust_region_radius = 10.0;
  Eigen::Matrix<double, Residuals::NUM_PARAMETERS, 1> x = p.template head<Residuals::NUM_PARAMETERS>();
  const auto summary = solver.Solve(residuals, &x);
  if (!x.allFinite() || !std::isfinite(summary.final_cost) || summary.final_cost > summary.initial_cost)
    return summary.initial_cost;
  p.template head<Residuals::NUM_PARAMETERS>() = x;
  return summary.final_cost;
}

}  // namespace

Result<std::unique_ptr<TexelFitter>> RfnlFitter::create(const FitProblem& problem) {
  const ModelDescription description = problem.model->description();
  const std::size_t unknowns = 4 * static_cast<std::size_t>(description.lobes) + 1;
  if (problem.lights.size() < unknowns)
    return fail(fmt::format("{} lights do not determine the {} numbers of a view of rfnl",
                            problem.lights.size(), unknowns),
                {}, "measure more lights, or fit fewer lobes");
  return std::unique_ptr<TexelFitter>(new RfnlFitter(problem));
}

RfnlFitter::RfnlFitter(const FitProblem& problem)
    : views_(problem.views.size()),
      lobes_(static_cast<std::size_t>(problem.model->description().lobes)),
      ownDiffuseAlbedo_(problem.model->description().diffuseAlbedo == DiffuseAlbedo::PerView) {
  const std::size_t count = problem.lights.size();
  double largestGap = 1.0;  // cosine
  for (std::size_t i = 0; i < count; ++i) {
    lights_.push_back(problem.lights[i]);
    cosines_.push_back(problem.cosineInModel ? 1.0 : problem.lights[i].z);
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return glm::dot(problem.lights[i], problem.lights[static_cast<std::size_t>(a)]) >
             glm::dot(problem.lights[i], problem.lights[static_cast<std::size_t>(b)]);
    });
    neighbors_.emplace_back(order.begin() + 1,
                            order.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(7, count)));
    largestGap = std::min(
        largestGap, double{glm::dot(problem.lights[i], problem.lights[static_cast<std::size_t>(order[1])])});
  }
  // A sharper lobe could hide between two lights and sparkle: half of the gap must not take it below one
  // half.
  const double halfGap = 0.5 * std::acos(std::clamp(largestGap, -1.0, 0.9999));
  largestExponent_ = std::clamp(std::log(0.5) / std::log(std::cos(halfGap)), 2.0, 1000.0);
}

namespace {

// Where a view's reflectance stands out from that of the neighbouring lights: the principal directions of
// M 4.1.
std::vector<std::size_t> peaksOf(const std::vector<double>& reflectance,
                                 const std::vector<std::vector<int>>& neighbors,
                                 const std::vector<glm::dvec3>& lights, std::size_t wanted) {
  std::vector<double> highPass(reflectance.size());
  for (std::size_t i = 0; i < reflectance.size(); ++i) {
    double mean = 0.0;
    for (int n : neighbors[i]) mean += reflectance[static_cast<std::size_t>(n)];
    highPass[i] = reflectance[i] - mean / static_cast<double>(neighbors[i].size());
  }
  std::vector<std::size_t> order(reflectance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return highPass[a] > highPass[b]; });
  std::vector<std::size_t> peaks;
  for (std::size_t candidate : order) {
    const bool apart = std::all_of(peaks.begin(), peaks.end(), [&](std::size_t other) {
      return glm::dot(lights[candidate], lights[other]) < 0.87;  // 30 degrees
    });
    if (apart) peaks.push_back(candidate);
    if (peaks.size() == wanted) break;
  }
  while (peaks.size() < wanted) peaks.push_back(order.front());
  return peaks;
}

template <int K>
void setLobe(Parameters<K>& p, int j, const Lobe& lobe) {
  p.template segment<4>(4 * j) << lobe.root, lobe.px, lobe.py, lobe.bend;
}

// Starting points for one view: a broad lobe and peaks, and peaks alone.
template <int K>
std::vector<Parameters<K>> startsFor(const ViewSamples& samples,
                                     const std::vector<std::vector<int>>& neighbors, double largestExponent) {
  std::vector<double> reflectance(samples.luminance.size());
  for (std::size_t i = 0; i < reflectance.size(); ++i)
    reflectance[i] = samples.luminance[i] / std::max(samples.cosines[i], 0.2);
  std::vector<double> sorted = reflectance;
  std::sort(sorted.begin(), sorted.end());
  const double floor = sorted[sorted.size() / 4];

  glm::dvec3 sum(0.0, 0.0, 1e-6);
  for (std::size_t i = 0; i < reflectance.size(); ++i)
    sum += std::max(reflectance[i] - floor, 0.0) * samples.lights[i];
  const glm::dvec3 broad = glm::normalize(sum);
  const double height = sorted[sorted.size() * 9 / 10] - floor;

  const std::vector<std::size_t> peaks = peaksOf(reflectance, neighbors, samples.lights, K);
  const auto peakLobe = [&](std::size_t k, double exponent) {
    return Lobe::from(0.5 * (reflectance[peaks[k]] - floor), samples.lights[peaks[k]], exponent,
                      largestExponent);
  };
  Parameters<K> broadAndPeaks;
  Parameters<K> peaksAlone;
  setLobe<K>(broadAndPeaks, 0, Lobe::from(height, broad, 2.0, largestExponent));
  for (int j = 1; j < K; ++j) setLobe<K>(broadAndPeaks, j, peakLobe(static_cast<std::size_t>(j - 1), 10.0));
  for (int j = 0; j < K; ++j) setLobe<K>(peaksAlone, j, peakLobe(static_cast<std::size_t>(j), 5.0));
  broadAndPeaks[4 * K] = peaksAlone[4 * K] = std::sqrt(std::max(0.8 * floor, 1e-6));
  return {broadAndPeaks, peaksAlone};
}

template <int K>
class TexelFit {
 public:
  TexelFit(std::span<const float> luminance, std::size_t views, const std::vector<glm::dvec3>& lights,
           const std::vector<double>& cosines, const std::vector<std::vector<int>>& neighbors,
           double largestExponent)
      : weights_(displayWeights(luminance)), largestExponent_(largestExponent) {
    const std::size_t count = lights.size();
    for (std::size_t v = 0; v < views; ++v)
      samples_.push_back({luminance.subspan(v * count, count), std::span(weights_).subspan(v * count, count),
                          lights, cosines});
    for (std::size_t v = 0; v < views; ++v) fitFirst(v, neighbors);
  }

  // Lets all views have one diffuse albedo: the best for the lobes, then the best lobes for it, in turn.
  void shareDiffuse() {
    constexpr int rounds = 3;  // a fourth changes the error by less than 1 %
    for (int round = 0; round < rounds; ++round) {
      const double root = std::sqrt(bestSharedDiffuse());
      for (std::size_t v = 0; v < samples_.size(); ++v) {
        parameters_[v][4 * K] = root;
        improve<K, false>(samples_[v], largestExponent_, 6, parameters_[v]);
      }
    }
  }

  double diffuse(std::size_t view) const { return parameters_[view][4 * K] * parameters_[view][4 * K]; }

  void write(std::size_t view, std::span<float> channels) const {
    for (int j = 0; j < K; ++j) {
      const auto p = parameters_[view].template segment<4>(4 * j);
      const Lobe lobe{p[0], p[1], p[2], p[3]};
      const auto out = channels.subspan(static_cast<std::size_t>(4 * j), 4);
      out[0] = static_cast<float>(lobe.amplitude());
      out[1] = static_cast<float>(lobe.px);
      out[2] = static_cast<float>(lobe.py);
      out[3] = static_cast<float>(lobe.exponent(largestExponent_));
      // A lobe that points away from all light is lost to the solver, and may have run off to infinity.
      const bool lost = !(lobe.px * lobe.px + lobe.py * lobe.py < 100.0) || !std::isfinite(lobe.amplitude());
      if (lost) out[0] = out[1] = out[2] = 0.0f;
    }
  }

 private:
  void fitFirst(std::size_t view, const std::vector<std::vector<int>>& neighbors) {
    std::vector<Parameters<K>> starts = startsFor<K>(samples_[view], neighbors, largestExponent_);
    if (view > 0) starts.push_back(parameters_[view - 1]);
    double best = std::numeric_limits<double>::infinity();
    parameters_.emplace_back();
    for (Parameters<K>& start : starts) {
      const double cost = improve<K, true>(samples_[view], largestExponent_, 10, start);
      if (cost < best) best = cost, parameters_[view] = start;
    }
  }

  double bestSharedDiffuse() const {
    double numerator = 0.0;
    double denominator = 1e-12;
    for (std::size_t v = 0; v < samples_.size(); ++v) {
      const ViewSamples& s = samples_[v];
      const std::vector<double> lobes = lobesOf<K>(parameters_[v], s, largestExponent_);
      for (std::size_t i = 0; i < lobes.size(); ++i) {
        const double squared = s.weights[i] * s.weights[i];
        numerator += squared * s.cosines[i] * (s.luminance[i] - lobes[i]);
        denominator += squared * s.cosines[i] * s.cosines[i];
      }
    }
    return std::max(numerator / denominator, 0.0);
  }

  std::vector<double> weights_;
  double largestExponent_;
  std::vector<ViewSamples> samples_;
  std::vector<Parameters<K>> parameters_;
};

}  // namespace

void RfnlFitter::fit(std::span<const float> luminance, std::span<float> shared,
                     std::span<float> views) const {
  const auto fitWith = [&]<int K>() {
    TexelFit<K> texel(luminance, views_, lights_, cosines_, neighbors_, largestExponent_);
    if (!ownDiffuseAlbedo_) texel.shareDiffuse();
    const std::size_t channels = views.size() / views_;
    for (std::size_t v = 0; v < views_; ++v) {
      const std::span<float> view = views.subspan(v * channels, channels);
      texel.write(v, view);
      if (ownDiffuseAlbedo_) view.back() = static_cast<float>(texel.diffuse(v));
    }
    if (!ownDiffuseAlbedo_) shared[3] = static_cast<float>(texel.diffuse(0));
  };
  static_assert(RfnlModel::kMaximumLobes == 4);
  if (lobes_ == 1) fitWith.template operator()<1>();
  if (lobes_ == 2) fitWith.template operator()<2>();
  if (lobes_ == 3) fitWith.template operator()<3>();
  if (lobes_ == 4) fitWith.template operator()<4>();
}

}  // namespace weft
