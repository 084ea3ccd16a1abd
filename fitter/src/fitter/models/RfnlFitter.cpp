#include "models/RfnlFitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "models/ExchangedFitter.h"
#include "solvers/LightSpacing.h"
#include "weft/core/Direction.h"
#include "weft/reflectance/RfnlModel.h"

namespace weft {
namespace {

// Four numbers of LobeJob::parameters.
using LobeParameters = std::array<float, 4>;

LobeParameters lobeParameters(float amplitude, glm::vec3 direction, float exponent, float largestExponent) {
  const float share = std::clamp(std::log(exponent) / std::log(largestExponent), 0.02f, 0.98f);
  const float z = std::max(direction.z, -0.5f);
  return {std::sqrt(std::max(amplitude, 1e-6f)), direction.x / (1.0f + z), direction.y / (1.0f + z),
          std::log(share / (1.0f - share))};
}

// A lobe as it is stored.
struct Lobe {
  float amplitude = 0.0f;
  glm::vec2 p{0.0f};
  float exponent = 1.0f;

  // A lobe that points away from all light is lost to the solver, which may have let it run off to
  // infinity.
  static Lobe from(std::span<const float> parameters, float largestExponent) {
    const glm::vec2 p(parameters[1], parameters[2]);
    const float amplitude = parameters[0] * parameters[0];
    if (!(glm::dot(p, p) < 100.0f) || !std::isfinite(amplitude)) return {};
    return {amplitude, p, std::pow(largestExponent, 1.0f / (1.0f + std::exp(-parameters[3])))};
  }

  glm::vec3 direction() const { return directionFromParabolic(p); }
};

// The value of lobes for a light, and its derivative by the light.
struct Value {
  float value = 0.0f;
  glm::vec3 gradient{0.0f};
};

Value valueOf(std::span<const Lobe> lobes, float diffuse, glm::vec3 light, bool modelHasCosine) {
  Value sum{diffuse, {}};
  for (const Lobe& lobe : lobes) {
    const glm::vec3 direction = lobe.direction();
    const float cosine = glm::dot(direction, light);
    if (cosine <= 0.0f) continue;
    const float value = lobe.amplitude * std::pow(cosine, lobe.exponent);
    sum.value += value;
    sum.gradient += value * lobe.exponent / cosine * direction;
  }
  if (modelHasCosine) return sum;
  return {sum.value * light.z, sum.gradient * light.z + glm::vec3(0.0f, 0.0f, sum.value)};
}

// Where one lobe is brightest: n.l lifts that above the lobe's own direction, to where cot(e) = n
// tan(e - d) with the elevations e of the light and d of the lobe; solved for small angles.
glm::vec3 brightestLight(const Lobe& lobe, bool modelHasCosine) {
  const glm::vec3 direction = lobe.direction();
  const float elevation = std::asin(std::clamp(direction.z, -1.0f, 1.0f));
  const float lifted = modelHasCosine
                           ? std::max(elevation, 0.0f)
                           : 0.5f * (elevation + std::sqrt(elevation * elevation + 4.0f / lobe.exponent));
  const glm::vec2 across(direction);
  const glm::vec2 azimuth = across / std::max(glm::length(across), 1e-6f);
  const float e = std::min(lifted, 0.5f * std::numbers::pi_v<float>);
  return {azimuth * std::cos(e), std::sin(e)};
}

// The light near a start that all lobes together reflect most. Where the gradient of the value is
// parallel to the light, the value is stationary; half a step to the gradient's direction, again
// and again, climbs there.
glm::vec3 brightestLight(std::span<const Lobe> lobes, float diffuse, glm::vec3 start, bool modelHasCosine) {
  constexpr int steps = 8;
  glm::vec3 light = start;
  for (int step = 0; step < steps; ++step) {
    const glm::vec3 gradient = valueOf(lobes, diffuse, light, modelHasCosine).gradient;
    const float length = glm::length(gradient);
    if (!(length > 0.0f)) break;
    light += gradient / length;
    light = glm::normalize(glm::vec3(light.x, light.y, std::max(light.z, 0.0f)));
  }
  return light;
}

// Between and below the measured lights nothing holds a lobe, and one that is seen only from its
// foot may tower there: the white pixels of [Meseth 2004] 5.3. Weakens lobes that exceed a limit
// anywhere.
void limitBrightness(std::span<Lobe> lobes, float diffuse, float limit, bool modelHasCosine) {
  float bound = diffuse;
  for (const Lobe& lobe : lobes) bound += lobe.amplitude;
  if (bound <= limit) return;
  for (std::size_t j = 0; j < lobes.size(); ++j) {
    const glm::vec3 light =
        brightestLight(lobes, diffuse, brightestLight(lobes[j], modelHasCosine), modelHasCosine);
    const float value = valueOf(lobes, diffuse, light, modelHasCosine).value;
    if (value <= limit) continue;
    const float own = valueOf(lobes.subspan(j, 1), 0.0f, light, modelHasCosine).value;
    if (own > 0.0f) lobes[j].amplitude *= std::max(1.0f - (value - limit) / own, 0.0f);
  }
}

// The six lights nearest to one, without itself, the nearest first.
std::vector<int> nearestLights(glm::vec3 light, const std::vector<glm::vec3>& lights) {
  std::vector<int> order(lights.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(),
                           [&](int i) { return glm::dot(light, lights[static_cast<std::size_t>(i)]); });
  return {order.begin() + 1,
          order.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(7, lights.size()))};
}

// The lights within 30 degrees of each, itself included.
std::vector<std::vector<int>> closeLights(const std::vector<glm::vec3>& lights) {
  std::vector<std::vector<int>> close(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (std::size_t k = 0; k < lights.size(); ++k)
      if (glm::dot(lights[i], lights[k]) > 0.87f) close[i].push_back(static_cast<int>(k));
  return close;
}

// Where a view's reflectance stands out from that of the neighbouring lights: the principal
// directions of [Meseth 2004] 4.1.
void findPeaks(const std::vector<float>& reflectance, const LightNeighbors& neighbors,
               std::vector<float>& highPass, std::span<std::size_t> peaks) {
  for (std::size_t i = 0; i < reflectance.size(); ++i) {
    float sum = 0.0f;
    for (int n : neighbors.nearest[i]) sum += reflectance[static_cast<std::size_t>(n)];
    highPass[i] = reflectance[i] - sum / static_cast<float>(neighbors.nearest[i].size());
  }
  for (std::size_t& peak : peaks) {
    peak = static_cast<std::size_t>(std::ranges::max_element(highPass) - highPass.begin());
    for (int i : neighbors.close[peak])
      highPass[static_cast<std::size_t>(i)] = -std::numeric_limits<float>::infinity();
  }
}

// All views of one texel.
class TexelFit {
 public:
  TexelFit(const LobeProblem& problem, const LightNeighbors& neighbors, int lobes,
           std::span<const float> targets, std::span<const float> weights)
      : problem_(problem),
        neighbors_(neighbors),
        lobes_(lobes),
        lights_(problem.lights.size()),
        views_(targets.size() / lights_),
        stride_(static_cast<std::size_t>(4 * lobes + 1)),
        targets_(targets),
        weights_(weights),
        parameters_(views_ * stride_),
        costs_(views_, std::numeric_limits<float>::infinity()),
        diffuseSlopes_(views_),
        reflectance_(lights_) {}

  // Every view alone, from a broad lobe and peaks, from peaks alone, and from what became of the
  // view before it, since neighbouring views look alike; the best goes on.
  void fitViews() {
    std::vector<float> broadAndPeaks;
    std::vector<float> peaksAlone;
    broadAndPeaks.reserve(parameters_.size());
    peaksAlone.reserve(parameters_.size());
    for (std::size_t v = 0; v < views_; ++v) appendStarts(v, broadAndPeaks, peaksAlone);
    tryStarts(std::move(broadAndPeaks));
    tryStarts(std::move(peaksAlone));
    std::vector<float> previous(parameters_.begin(),
                                parameters_.begin() + static_cast<std::ptrdiff_t>(stride_));
    previous.insert(previous.end(), parameters_.begin(),
                    parameters_.end() - static_cast<std::ptrdiff_t>(stride_));
    tryStarts(std::move(previous));
  }

  // Lets every view keep a diffuse albedo of its own.
  void polish() { improve(DiffuseSolve::Solve, 10); }

  // Lets all views have one diffuse albedo up to a largest one: the best for the lobes, then the
  // best lobes for it, in turn.
  void shareDiffuse(float largest) {
    constexpr int rounds = 3;  // a fourth changes the error by less than 1 %
    for (int round = 0; round < rounds; ++round) {
      const float root = std::sqrt(std::min(bestSharedDiffuse(), largest));
      for (std::size_t v = 0; v < views_; ++v) parameters_[v * stride_ + stride_ - 1] = root;
      improve(DiffuseSolve::Hold, 5);
    }
  }

  float diffuse(std::size_t view) const {
    const float root = parameters_[view * stride_ + stride_ - 1];
    return root * root;
  }

  // Amplitude, parabolic direction and exponent of every lobe.
  void write(std::size_t view, float brightestShare, bool modelHasCosine, std::span<float> channels) const {
    std::vector<Lobe> lobes = lobesOf(view);
    limitBrightness(lobes, diffuse(view), brightestShare * brightestSample(view), modelHasCosine);
    for (std::size_t j = 0; j < lobes.size(); ++j)
      std::ranges::copy(std::array{lobes[j].amplitude, lobes[j].p.x, lobes[j].p.y, lobes[j].exponent},
                        channels.subspan(4 * j).begin());
  }

  float brightestSample(std::size_t view) const {
    return std::ranges::max(targets_.subspan(view * lights_, lights_));
  }

  // The brightest sample of the view that has the darkest one; entirely black views do not count.
  float brightestOfDarkestView() const {
    float darkest = std::numeric_limits<float>::max();
    for (std::size_t v = 0; v < views_; ++v)
      if (const float brightest = brightestSample(v); brightest > 0.0f)
        darkest = std::min(darkest, brightest);
    return darkest;
  }

 private:
  std::vector<Lobe> lobesOf(std::size_t view) const {
    std::vector<Lobe> lobes;
    for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j)
      lobes.push_back(
          Lobe::from(std::span(parameters_).subspan(view * stride_ + 4 * j, 4), problem_.largestExponent));
    return lobes;
  }

  void appendStarts(std::size_t view, std::vector<float>& broadAndPeaks, std::vector<float>& peaksAlone) {
    for (std::size_t i = 0; i < lights_; ++i)
      reflectance_[i] = targets_[view * lights_ + i] / std::max(problem_.cosines[i], 0.2f);
    // The quarter's rank first: what is above it is then all that the other must look at.
    scratch_ = reflectance_;
    const auto rank = [&](std::size_t r) { return scratch_.begin() + static_cast<std::ptrdiff_t>(r); };
    std::nth_element(scratch_.begin(), rank(lights_ / 4), scratch_.end());
    const float floor = scratch_[lights_ / 4];
    std::nth_element(rank(lights_ / 4), rank(lights_ * 9 / 10), scratch_.end());
    const float high = scratch_[lights_ * 9 / 10];
    const float largest = problem_.largestExponent;
    const auto append = [](std::vector<float>& starts, const LobeParameters& lobe) {
      starts.insert(starts.end(), lobe.begin(), lobe.end());
    };

    glm::vec3 sum(0.0f, 0.0f, 1e-6f);
    for (std::size_t i = 0; i < lights_; ++i)
      sum += std::max(reflectance_[i] - floor, 0.0f) * problem_.lights[i];
    append(broadAndPeaks, lobeParameters(high - floor, glm::normalize(sum), 2.0f, largest));
    std::array<std::size_t, RfnlModel::kMaximumLobes> peaks{};
    findPeaks(reflectance_, neighbors_, scratch_, std::span(peaks).first(static_cast<std::size_t>(lobes_)));
    for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j) {
      const float height = 0.5f * (reflectance_[peaks[j]] - floor);
      append(peaksAlone, lobeParameters(height, problem_.lights[peaks[j]], 5.0f, largest));
      if (j + 1 < static_cast<std::size_t>(lobes_))
        append(broadAndPeaks, lobeParameters(height, problem_.lights[peaks[j]], 10.0f, largest));
    }
    const float diffuseRoot = std::sqrt(std::max(0.8f * floor, 1e-6f));
    broadAndPeaks.push_back(diffuseRoot);
    peaksAlone.push_back(diffuseRoot);
  }

  std::vector<LobeJob> jobsAt(std::vector<float>& parameters) const {
    std::vector<LobeJob> jobs(views_);
    for (std::size_t v = 0; v < views_; ++v)
      jobs[v] = {&targets_[v * lights_], &weights_[v * lights_], &parameters[v * stride_]};
    return jobs;
  }

  // Follows a start of every view a few iterations and keeps it where it is the best so far.
  void tryStarts(std::vector<float> starts) {
    std::vector<LobeJob> jobs = jobsAt(starts);
    solveLobes(problem_, lobes_, DiffuseSolve::Solve, 4, jobs);
    for (std::size_t v = 0; v < views_; ++v)
      if (jobs[v].cost < costs_[v]) {
        costs_[v] = jobs[v].cost;
        diffuseSlopes_[v] = jobs[v].diffuseSlope;
        std::copy_n(jobs[v].parameters, stride_, &parameters_[v * stride_]);
      }
  }

  void improve(DiffuseSolve diffuse, int iterations) {
    std::vector<LobeJob> jobs = jobsAt(parameters_);
    solveLobes(problem_, lobes_, diffuse, iterations, jobs);
    for (std::size_t v = 0; v < views_; ++v) diffuseSlopes_[v] = jobs[v].diffuseSlope;
  }

  // Where the slopes of all views' costs would cancel: the costs are parabolas of the albedo as
  // long as the lobes stay.
  float bestSharedDiffuse() const {
    double numerator = 0.0;
    double denominator = 1e-12;
    for (std::size_t v = 0; v < views_; ++v) {
      double curvature = 0.0;
      for (std::size_t i = 0; i < lights_; ++i) {
        const double scale = double{weights_[v * lights_ + i]} * problem_.cosines[i];
        curvature += scale * scale;
      }
      numerator += curvature * diffuse(v) - diffuseSlopes_[v];
      denominator += curvature;
    }
    return static_cast<float>(std::max(numerator / denominator, 0.0));
  }

  const LobeProblem& problem_;
  const LightNeighbors& neighbors_;
  int lobes_;
  std::size_t lights_;
  std::size_t views_;
  std::size_t stride_;  // numbers a view
  std::span<const float> targets_;
  std::span<const float> weights_;
  std::vector<float> parameters_;  // [view][LobeJob::parameters]
  std::vector<float> costs_;
  std::vector<float> diffuseSlopes_;
  std::vector<float> reflectance_;  // of the view whose starts are sought
  std::vector<float> scratch_;
};

// A white pixel of [Meseth 2004] 5.3 exceeds its view's brightest sample 1.5 times; less than that,
// with room for rounding. What a light field shows between the measured views has no such bound.
float brightestShareOf(const FitProblem& problem) {
  if (problem.model->layerDirections() == LayerDirections::Lights) return 2.0f;
  return problem.weighted ? 1.35f : std::pow(1.35f, 1.0f / 2.2f);
}

}  // namespace

Result<std::unique_ptr<TexelFitter>> RfnlFitter::create(const FitProblem& problem) {
  const std::size_t unknowns = 4 * static_cast<std::size_t>(problem.model->options().number("lobes")) + 1;
  if (problem.lights.size() < unknowns)
    return fail(fmt::format("{} directions do not determine the {} numbers of a layer of lobes",
                            problem.lights.size(), unknowns),
                {}, "measure more lights, or fit fewer lobes");
  return std::unique_ptr<TexelFitter>(new RfnlFitter(problem));
}

Result<std::unique_ptr<TexelFitter>> RfnlFitter::createForLights(const FitProblem& problem) {
  return ExchangedFitter::create(problem, RfnlFitter::create);
}

RfnlFitter::RfnlFitter(const FitProblem& problem)
    : lobes_(problem.model->options().number("lobes")),
      ownDiffuseAlbedo_(problem.model->options().word("rho_d") == "per-view"),
      modelHasCosine_(problem.cosineInModel),
      layersAreViews_(problem.model->layerDirections() == LayerDirections::Views),
      brightestShare_(brightestShareOf(problem)) {
  problem_.lights = problem.lights;
  problem_.largestExponent = sharpestExponent(problem.lights);
  for (const glm::vec3 light : problem.lights) {
    problem_.cosines.push_back(problem.cosineInModel ? 1.0f : light.z);
    neighbors_.nearest.push_back(nearestLights(light, problem.lights));
  }
  neighbors_.close = closeLights(problem.lights);
}

void RfnlFitter::fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
                     std::span<float> layers) const {
  TexelFit texel(problem_, neighbors_, lobes_, targets, weights);
  texel.fitViews();
  // A diffuse albedo that all views share makes white pixels of those that hardly see the texel.
  const float largestDiffuse =
      layersAreViews_ ? brightestShare_ * texel.brightestOfDarkestView() : std::numeric_limits<float>::max();
  ownDiffuseAlbedo_ ? texel.polish() : texel.shareDiffuse(largestDiffuse);
  const std::size_t viewCount = targets.size() / problem_.lights.size();
  const std::size_t numbers = layers.size() / viewCount;
  for (std::size_t v = 0; v < viewCount; ++v) {
    const std::span<float> layer = layers.subspan(v * numbers, numbers);
    texel.write(v, brightestShare_, modelHasCosine_, layer);
    if (ownDiffuseAlbedo_) layer.back() = texel.diffuse(v);
  }
  if (!ownDiffuseAlbedo_) shared[0] = texel.diffuse(0);
}

}  // namespace weft
