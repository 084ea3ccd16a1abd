#include "RfnlFitter.h"

#include <ceres/tiny_solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
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
  const RfnlProblem& problem;
};

// A lobe as the solver sees it: four numbers without bounds. amplitude = root^2; the direction in parabolic
// coordinates; exponent = largest^sigmoid(bend), between 1 and the largest that is allowed.
struct Lobe {
  double root = 0.0;
  double px = 0.0, py = 0.0;
  double bend = 0.0;

  double amplitude() const { return root * root; }
  Eigen::Vector4d vector() const { return {root, px, py, bend}; }
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
  double diffuse;  // where it is held

  int NumResiduals() const { return static_cast<int>(samples.luminance.size()); }

  bool operator()(const double* p, double* residuals, double* jacobian) const {
    const std::size_t count = samples.luminance.size();
    for (std::size_t i = 0; i < count; ++i) {
      const double scale = samples.weights[i] * samples.problem.cosines[i];
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
    const double logLargest = std::log(samples.problem.largestExponent);
    const double exponent = std::exp(logLargest * sigmoid);
    const double exponentByBend = exponent * logLargest * sigmoid * (1.0 - sigmoid);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 l = samples.problem.lights[i];
      const double dot = glm::dot(m, l);
      const double scale = samples.weights[i] * samples.problem.cosines[i];
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
std::vector<double> lobesOf(const Parameters<K>& p, const ViewSamples& samples) {
  const std::vector<double> ones(samples.luminance.size(), 1.0);
  const std::vector<float> black(samples.luminance.size(), 0.0f);
  const ViewSamples unweighted{black, ones, samples.problem};
  std::vector<double> values(samples.luminance.size());
  ViewResiduals<K, false>{unweighted, 0.0}(p.data(), values.data(), nullptr);
  return values;
}

// Improves `p` from where it is; returns half the sum of squares.
template <int K, bool SolveDiffuse>
double improve(const ViewSamples& samples, int iterations, Parameters<K>& p) {
  using Residuals = ViewResiduals<K, SolveDiffuse>;
  const Residuals residuals{samples, p[4 * K] * p[4 * K]};
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

// The six lights nearest to one, without itself, the nearest first.
std::vector<int> nearestLights(glm::dvec3 light, const std::vector<glm::vec3>& lights) {
  std::vector<int> order(lights.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](int i) {
    return glm::dot(light, glm::dvec3(lights[static_cast<std::size_t>(i)]));
  });
  return {order.begin() + 1,
          order.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(7, lights.size()))};
}

// Where a view's reflectance stands out from that of the neighbouring lights: the principal directions of
// M 4.1.
std::vector<std::size_t> peaksOf(const std::vector<double>& reflectance, const RfnlProblem& problem,
                                 std::size_t wanted) {
  std::vector<double> highPass(reflectance.size());
  for (std::size_t i = 0; i < reflectance.size(); ++i) {
    double mean = 0.0;
    for (int n : problem.neighbors[i]) mean += reflectance[static_cast<std::size_t>(n)];
    highPass[i] = reflectance[i] - mean / static_cast<double>(problem.neighbors[i].size());
  }
  std::vector<std::size_t> order(reflectance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return highPass[i]; });
  std::vector<std::size_t> peaks;
  for (std::size_t candidate : order) {
    const bool apart = std::ranges::all_of(peaks, [&](std::size_t other) {
      return glm::dot(problem.lights[candidate], problem.lights[other]) < 0.87;  // 30 degrees
    });
    if (apart) peaks.push_back(candidate);
    if (peaks.size() == wanted) break;
  }
  peaks.resize(wanted, order.front());
  return peaks;
}

// Starting points for one view: a broad lobe and peaks, and peaks alone.
template <int K>
std::array<Parameters<K>, 2> startsFor(const ViewSamples& samples) {
  const RfnlProblem& problem = samples.problem;
  std::vector<double> reflectance(samples.luminance.size());
  for (std::size_t i = 0; i < reflectance.size(); ++i)
    reflectance[i] = samples.luminance[i] / std::max(problem.cosines[i], 0.2);
  std::vector<double> sorted = reflectance;
  std::ranges::sort(sorted);
  const double floor = sorted[sorted.size() / 4];

  glm::dvec3 sum(0.0, 0.0, 1e-6);
  for (std::size_t i = 0; i < reflectance.size(); ++i)
    sum += std::max(reflectance[i] - floor, 0.0) * problem.lights[i];
  const Lobe broad =
      Lobe::from(sorted[sorted.size() * 9 / 10] - floor, glm::normalize(sum), 2.0, problem.largestExponent);
  const std::vector<std::size_t> peaks = peaksOf(reflectance, problem, K);
  const auto peak = [&](int k, double exponent) {
    const std::size_t light = peaks[static_cast<std::size_t>(k)];
    return Lobe::from(0.5 * (reflectance[light] - floor), problem.lights[light], exponent,
                      problem.largestExponent);
  };
  std::array<Parameters<K>, 2> starts;
  for (int j = 0; j < K; ++j) {
    starts[0].template segment<4>(4 * j) = (j == 0 ? broad : peak(j - 1, 10.0)).vector();
    starts[1].template segment<4>(4 * j) = peak(j, 5.0).vector();
  }
  starts[0][4 * K] = starts[1][4 * K] = std::sqrt(std::max(0.8 * floor, 1e-6));
  return starts;
}

// A lobe as it is stored.
struct WrittenLobe {
  double amplitude = 0.0;
  glm::dvec2 p{0.0};
  double exponent = 1.0;

  // A lobe that points away from all light is lost to the solver, which may have let it run off to infinity.
  static WrittenLobe from(const Lobe& lobe, double largestExponent) {
    const bool lost = !(lobe.px * lobe.px + lobe.py * lobe.py < 100.0) || !std::isfinite(lobe.amplitude());
    if (lost) return {};
    return {lobe.amplitude(), {lobe.px, lobe.py}, lobe.exponent(largestExponent)};
  }

  double valueAt(glm::dvec3 light) const {
    const glm::dvec3 direction = directionFromParabolic(glm::vec2(p));
    return amplitude * std::pow(std::max(glm::dot(direction, light), 0.0), exponent);
  }
};

// Between and below the measured lights nothing holds a lobe, and one that is seen only from its foot may
// tower there: the white pixels of M 5.3. Weakens lobes that, anywhere on the meridian through them, exceed
// the view's brightest sample by far.
template <std::size_t K>
void limitBrightness(std::array<WrittenLobe, K>& lobes, double diffuse, const ViewSamples& samples) {
  constexpr std::array heights{0.02, 0.05, 0.1, 0.15, 0.2, 0.26, 0.35, 0.5, 0.7, 0.87, 1.0};  // z of a light
  const double limit = 1.35 * std::ranges::max(samples.luminance);
  for (WrittenLobe& lobe : lobes) {
    const glm::dvec2 azimuth = glm::length(lobe.p) > 1e-6 ? glm::normalize(lobe.p) : glm::dvec2(1.0, 0.0);
    for (double z : heights) {
      const glm::dvec3 light(azimuth * std::sqrt(1.0 - z * z), z);
      double value = diffuse;
      for (const WrittenLobe& other : lobes) value += other.valueAt(light);
      if (!samples.problem.modelHasCosine) value *= z;
      if (value > limit) lobe.amplitude *= limit / value;
    }
  }
}

// All views of one texel, K lobes each.
template <int K>
class TexelFit {
 public:
  TexelFit(std::span<const float> luminance, const RfnlProblem& problem)
      : weights_(displayWeights(luminance)) {
    const std::size_t count = problem.lights.size();
    for (std::size_t v = 0; v < problem.views; ++v)
      samples_.push_back(
          {luminance.subspan(v * count, count), std::span(weights_).subspan(v * count, count), problem});
    for (std::size_t v = 0; v < problem.views; ++v) parameters_.push_back(fitWithOwnDiffuse(v));
  }

  // Lets all views have one diffuse albedo: the best for the lobes, then the best lobes for it, in turn.
  void shareDiffuse() {
    constexpr int rounds = 3;  // a fourth changes the error by less than 1 %
    for (int round = 0; round < rounds; ++round) {
      const double root = std::sqrt(bestSharedDiffuse());
      for (std::size_t v = 0; v < samples_.size(); ++v) {
        parameters_[v][4 * K] = root;
        improve<K, false>(samples_[v], 4, parameters_[v]);
      }
    }
  }

  double diffuse(std::size_t view) const { return parameters_[view][4 * K] * parameters_[view][4 * K]; }

  // Amplitude, parabolic direction and exponent of every lobe.
  void write(std::size_t view, std::span<float> channels) const {
    std::array<WrittenLobe, K> lobes;
    for (int j = 0; j < K; ++j) {
      const auto p = parameters_[view].template segment<4>(4 * j);
      lobes[static_cast<std::size_t>(j)] =
          WrittenLobe::from({p[0], p[1], p[2], p[3]}, samples_[view].problem.largestExponent);
    }
    limitBrightness(lobes, diffuse(view), samples_[view]);
    for (std::size_t j = 0; j < K; ++j) {
      const WrittenLobe& lobe = lobes[j];
      const std::array values{lobe.amplitude, lobe.p.x, lobe.p.y, lobe.exponent};
      std::ranges::transform(values, channels.subspan(4 * j, 4).begin(),
                             [](double v) { return static_cast<float>(v); });
    }
  }

 private:
  // The best of several starts, of which the previous view's fit is one: neighbouring views look alike.
  Parameters<K> fitWithOwnDiffuse(std::size_t view) const {
    const auto starts = startsFor<K>(samples_[view]);
    std::vector<Parameters<K>> candidates(starts.begin(), starts.end());
    if (view > 0) candidates.push_back(parameters_[view - 1]);
    double best = std::numeric_limits<double>::infinity();
    Parameters<K> result = candidates.front();
    for (Parameters<K>& candidate : candidates) {
      const double cost = improve<K, true>(samples_[view], 4, candidate);
      if (cost < best) best = cost, result = candidate;
    }
    improve<K, true>(samples_[view], 8, result);
    return result;
  }

  double bestSharedDiffuse() const {
    double numerator = 0.0;
    double denominator = 1e-12;
    for (std::size_t v = 0; v < samples_.size(); ++v) {
      const ViewSamples& s = samples_[v];
      const std::vector<double> lobes = lobesOf<K>(parameters_[v], s);
      for (std::size_t i = 0; i < lobes.size(); ++i) {
        const double squared = s.weights[i] * s.weights[i];
        numerator += squared * s.problem.cosines[i] * (s.luminance[i] - lobes[i]);
        denominator += squared * s.problem.cosines[i] * s.problem.cosines[i];
      }
    }
    return std::max(numerator / denominator, 0.0);
  }

  std::vector<double> weights_;
  std::vector<ViewSamples> samples_;
  std::vector<Parameters<K>> parameters_;
};

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
    : lobes_(problem.model->description().lobes),
      ownDiffuseAlbedo_(problem.model->description().diffuseAlbedo == DiffuseAlbedo::PerView) {
  problem_.views = problem.views.size();
  problem_.modelHasCosine = problem.cosineInModel;
  double largestGap = 0.0;
  for (const glm::dvec3 light : problem.lights) {
    problem_.lights.push_back(light);
    problem_.cosines.push_back(problem.cosineInModel ? 1.0 : light.z);
    problem_.neighbors.push_back(nearestLights(light, problem.lights));
    const glm::dvec3 nearest = problem.lights[static_cast<std::size_t>(problem_.neighbors.back().front())];
    largestGap = std::max(largestGap, std::acos(std::clamp(glm::dot(light, nearest), -1.0, 1.0)));
  }
  // Half of the gap between two lights must not take a lobe below one half.
  problem_.largestExponent = std::clamp(std::log(0.5) / std::log(std::cos(0.5 * largestGap)), 2.0, 1000.0);
}

void RfnlFitter::fit(std::span<const float> luminance, std::span<float> shared,
                     std::span<float> views) const {
  const auto fitWith = [&]<int K>() {
    TexelFit<K> texel(luminance, problem_);
    if (!ownDiffuseAlbedo_) texel.shareDiffuse();
    const std::size_t channels = views.size() / problem_.views;
    for (std::size_t v = 0; v < problem_.views; ++v) {
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
