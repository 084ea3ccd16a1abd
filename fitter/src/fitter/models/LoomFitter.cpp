#include "models/LoomFitter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include "FitWeights.h"
#include "solvers/ComponentBasis.h"
#include "solvers/GlossLevels.h"
#include "solvers/LightPolynomials.h"
#include "solvers/LoomHue.h"
#include "solvers/LoomLevels.h"
#include "solvers/PackedSamples.h"
#include "weft/core/BatchEncoding.h"
#include "weft/core/Color.h"
#include "weft/reflectance/FieldFormula.h"
#include "weft/reflectance/LightMaps.h"

namespace weft {
namespace {

constexpr int kWindowSide = 128;
// Smaller samples are registered as if they repeated: without what wraps little would be left.
constexpr int kSmallestWindow = 48;
constexpr std::size_t kWindowLights = 12;
constexpr std::size_t kHueNumbers = 4;

// GL's RGB9_E5, as which a GPU keeps base colours.
glm::vec3 roundedColor(glm::vec3 color) {
  return glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(glm::max(color, 0.0f)));
}

float roundedWeight(float weight) {
  return std::round(127.0f * std::clamp(weight, -1.0f, 1.0f)) / 127.0f;
}

/// Of the training texels, the samples that gatherTraining() packed.
std::vector<glm::vec3> unpackedTexels(std::span<const std::vector<double>> ofRows, std::size_t pairs) {
  const std::size_t packed = packedSize(3 * pairs);
  std::size_t texels = 0;
  for (const std::vector<double>& row : ofRows) texels += row.size() / packed;
  std::vector<glm::vec3> samples(texels * pairs);
  std::span<glm::vec3> rest = samples;
  for (const std::vector<double>& row : ofRows)
    for (std::size_t at = 0; at + packed <= row.size(); at += packed) {
      unpackSamples(std::span(row).subspan(at, packed), floatsOf(rest.first(pairs)));
      rest = rest.subspan(pairs);
    }
  return samples;
}

}  // namespace

Result<std::unique_ptr<FieldFitter>> LoomFitter::create(const FitProblem& problem) {
  auto fitter = std::make_unique<LoomFitter>(problem);
  if (fitter->hasGloss()) {
    if (!problem.weighted || problem.cosineInModel)
      return fail("a lobe of gloss adds up with linear light, and without n.l alone", {},
                  "fit with --space linear and --cosine out");
    // so that what it cannot do is known before the work
    const std::vector<float> grey(fitter->pairs(), 1.0f);
    WEFT_TRY_VOID(fitter->setGloss(grey));
  }
  return fitter;
}

LoomFitter::LoomFitter(const FitProblem& problem)
    : problem_(problem),
      components_(static_cast<std::size_t>(problem.model->options().number("components"))),
      firstWeight_(dynamic_cast<const LoomModel&>(*problem.model).firstWeight()),
      windowLights_(spreadLights(problem.lights.size(), kWindowLights)),
      training_(problem.width, problem.height, problem.views.size() * problem.lights.size()) {
  window_.width = std::min(problem.width, kWindowSide);
  window_.height = std::min(problem.height, kWindowSide);
  window_.x = (problem.width - window_.width) / 2;
  window_.y = (problem.height - window_.height) / 2;
}

void LoomFitter::gather(int pass, TexelRun& texels, std::vector<double>& ofRow) const {
  pass == 0 ? gatherWindow(texels, ofRow) : gatherTraining(texels, ofRow);
}

Result<void> LoomFitter::endPass(int pass, std::span<const std::vector<double>> ofRows) {
  if (pass == 1) return findComponents(ofRows);
  registerWindow(ofRows);
  return {};
}

void LoomFitter::gatherWindow(TexelRun& texels, std::vector<double>& ofRow) const {
  std::vector<float> values;
  for (int i = 0; i < texels.size(); ++i) {
    if (!window_.contains(texels.x() + i, texels.y())) continue;
    const std::vector<glm::vec3>& stored = texels.fitted(i).stored;
    values.clear();
    for (std::size_t view = 0; view < problem_.views.size(); ++view)
      for (const std::size_t light : windowLights_)
        values.push_back(luminance(stored[view * problem_.lights.size() + light]));
    packSamples(values, ofRow);
  }
}

void LoomFitter::registerWindow(std::span<const std::vector<double>> ofRows) {
  const std::size_t ofTexel = problem_.views.size() * windowLights_.size();
  LuminanceWindow window{.width = window_.width,
                         .height = window_.height,
                         .views = problem_.views,
                         .lights = static_cast<int>(windowLights_.size()),
                         .values = {},
                         .wraps = std::min(problem_.width, problem_.height) < kSmallestWindow &&
                                  window_.width == problem_.width && window_.height == problem_.height};
  std::vector<float> values(ofTexel);
  for (const std::vector<double>& row : ofRows)
    for (std::size_t at = 0; at < row.size(); at += packedSize(ofTexel)) {
      unpackSamples(std::span(row).subspan(at, packedSize(ofTexel)), values);
      for (const float value : values)
        window.values.push_back(static_cast<std::uint8_t>(255.0f * std::clamp(value, 0.0f, 1.0f) + 0.5f));
    }
  shifts_ = registerViews(window);
}

std::span<const glm::vec3> LoomFitter::valuesOf(const TexelSamples& samples) const {
  return problem_.weighted ? samples.linear : samples.stored;
}

void LoomFitter::gatherTraining(TexelRun& texels, std::vector<double>& ofRow) const {
  std::vector<glm::vec3> values;
  for (int i = 0; i < texels.size(); ++i) {
    if (!training_.contains(texels.x() + i, texels.y())) continue;
    const std::span<const glm::vec3> samples = valuesOf(texels.fitted(i));
    values.assign(samples.begin(), samples.end());
    packSamples(floatsOf(std::span(values)), ofRow);
  }
}

float LoomFitter::squaredWeight(float value) const {
  if (!problem_.weighted) return 1.0f;
  const float weight = displayWeight(value);
  return weight * weight;
}

// From luminances of some texels: errors count as a display shows them at the means.
Result<void> LoomFitter::setGloss(std::span<const float> values) {
  std::vector<float> means(pairs());
  const auto texels = static_cast<float>(values.size() / pairs());
  for (std::size_t i = 0; i < values.size(); ++i) means[i % pairs()] += values[i] / texels;
  WEFT_TRY(glossSolver_, GlossSolver::create(problem_.views, problem_.lights, means));
  return {};
}

// Of texels, and of their luminances.
void LoomFitter::removeGloss(std::span<glm::vec3> samples, std::span<float> values) const {
  constexpr std::size_t kTexels = WeightedLeastSquares::kSetsAtOnce;
  const std::size_t step = kTexels * pairs(), count = (values.size() + step - 1) / step;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t part) {
    const std::size_t first = part * step;
    const auto ofPart = values.subspan(first, std::min(step, values.size() - first));
    const std::vector<GlossLobe> lobes = glossSolver_->solve(ofPart);
    for (std::size_t texel = 0; texel < lobes.size(); ++texel) {
      if (lobes[texel].amount == 0.0f) continue;
      const std::vector<float> gloss = glossSolver_->valuesOf(lobes[texel]);
      for (std::size_t pair = 0; pair < gloss.size(); ++pair) {
        ofPart[texel * pairs() + pair] -= gloss[pair];
        samples[first + texel * pairs() + pair] -= gloss[pair];
      }
    }
  });
}

Result<void> LoomFitter::findComponents(std::span<const std::vector<double>> ofRows) {
  std::vector<glm::vec3> samples = unpackedTexels(ofRows, pairs());
  std::vector<float> values(samples.size()), squaredWeights(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    values[i] = luminance(samples[i]);
    squaredWeights[i] = squaredWeight(values[i]);
  }
  if (hasGloss()) {
    WEFT_TRY_VOID(setGloss(values));
    removeGloss(samples, values);
  }
  std::vector<float> basis = fitComponentBasis(values, pairs(), components_);
  std::vector<float> weights(samples.size() / pairs() * components_);
  WeightedLeastSquares(basis, components_).solve(values, squaredWeights, weights);

  // Weights of all texels should lie in -1..1.
  constexpr float kBeyondTraining = 1.15f;
  for (std::size_t k = 0; k < components_; ++k) {
    float largest = 0.0f;
    for (std::size_t i = k; i < weights.size(); i += components_)
      largest = std::max(largest, std::abs(weights[i]));
    const float scale = largest > 0.0f ? kBeyondTraining * largest : 1.0f;
    for (std::size_t i = k; i < weights.size(); i += components_) weights[i] /= scale;
    for (std::size_t i = k; i < basis.size(); i += components_) basis[i] *= scale;
  }
  const std::vector<float> hue = fitHue(samples, basis, weights, components_, problem_.weighted);
  tables_["light_maps"] = lightMaps(basis, hue);
  tables_["light_polynomials"] =
      lightPolynomialTable(tables_["light_maps"], 1, LoomModel::kQuadratic, components_);
  tables_["registration"] = registrationTable();
  WEFT_TRY(const auto bound, boundModel(problem_.model, std::make_shared<const FieldTables>(tables_)));
  setTerms(bound);
  gram_ = weightedGram(terms_, components_, squaredWeights);
  return {};
}

FloatImage LoomFitter::registrationTable() const {
  const std::vector<std::string> channels{"deviation_x", "deviation_y", "height"};
  FloatImage table(static_cast<int>(problem_.views.size()), 1, channels);
  for (int view = 0; view < table.width(); ++view) {
    const auto i = static_cast<std::size_t>(view);
    const glm::vec2 deviation =
        glm::vec2(shifts_.offsets[i]) - shifts_.height * reliefTangent(problem_.views[i]);
    table.at(view, 0, 0) = deviation.x;
    table.at(view, 0, 1) = deviation.y;
    table.at(view, 0, 2) = shifts_.height;
  }
  return table;
}

// Without n.l, unless the model is to contain it.
FloatImage LoomFitter::lightMaps(std::span<const float> basis, std::span<const float> hue) const {
  constexpr float kLowest = 0.02f;
  const std::size_t lights = problem_.lights.size(), channels = components_ + kHueNumbers;
  const LightMaps maps(problem_.lights);
  const ModelTable declared = problem_.model->tables().front();
  FloatImage image(maps.size() * static_cast<int>(problem_.views.size()), maps.size(), declared.channels);
  std::vector<float> values(lights * channels);
  for (std::size_t view = 0; view < problem_.views.size(); ++view) {
    for (std::size_t light = 0; light < lights; ++light) {
      const std::size_t pair = view * lights + light;
      const float cosine = problem_.cosineInModel ? 1.0f : std::max(problem_.lights[light].z, kLowest);
      for (std::size_t k = 0; k < channels; ++k)
        values[light * channels + k] =
            (k < components_ ? basis[pair * components_ + k] : hue[pair * kHueNumbers + k - components_]) /
            cosine;
    }
    const std::vector<float> map = maps.filled(values, channels);
    for (int y = 0; y < maps.size(); ++y)
      for (int x = 0; x < maps.size(); ++x)
        std::copy_n(map.begin() +
                        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y * maps.size() + x) * channels),
                    channels, image.texel(static_cast<int>(view) * maps.size() + x, y).begin());
  }
  image.roundToHalf();
  return image;
}

// What the maps give at the measured lights once they are rounded.
void LoomFitter::setTerms(std::shared_ptr<const ReflectanceModel> bound) {
  const std::size_t channels = components_ + kHueNumbers;
  for (std::size_t view = 0; view < problem_.views.size(); ++view) {
    const std::vector<float> sampled =
        bound->sampledLayer(bound->commonLayer(static_cast<int>(view)), problem_.lights);
    for (std::size_t light = 0; light < problem_.lights.size(); ++light) {
      const float cosine = problem_.cosineInModel ? 1.0f : problem_.lights[light].z;
      for (std::size_t k = 0; k < channels; ++k)
        (k < components_ ? terms_ : hues_).push_back(cosine * sampled[light * channels + k]);
    }
  }
  solver_.emplace(terms_, components_);
}

void LoomFitter::fit(TexelRun& texels, RunParameters& parameters) const {
  const auto count = static_cast<std::size_t>(texels.size());
  std::vector<float> values(count * pairs()), squaredWeights(count * pairs());
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const glm::vec3> samples = valuesOf(texels.fitted(static_cast<int>(i)));
    for (std::size_t pair = 0; pair < pairs(); ++pair) {
      const float value = luminance(samples[pair]);
      values[i * pairs() + pair] = value;
      squaredWeights[i * pairs() + pair] = squaredWeight(value);
    }
  }
  std::vector<GlossLobe> lobes;
  std::vector<float> gloss(hasGloss() ? values.size() : 0);
  if (hasGloss()) lobes = glossSolver_->solve(values);
  for (std::size_t i = 0; i < lobes.size(); ++i)
    if (lobes[i].amount > 0.0f) std::ranges::copy(glossSolver_->valuesOf(lobes[i]), &gloss[i * pairs()]);
  for (std::size_t i = 0; i < gloss.size(); ++i) values[i] -= gloss[i];
  std::vector<float> weights(count * components_);
  solver_->solve(values, squaredWeights, weights);
  for (float& weight : weights) weight = roundedWeight(weight);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<float> shared = parameters.shared(static_cast<int>(i));
    const std::span<const float> ofTexel = std::span(weights).subspan(i * components_, components_);
    const auto glossOfTexel = std::span<const float>(gloss).subspan(hasGloss() ? i * pairs() : 0);
    const glm::vec3 color = baseColor(valuesOf(texels.fitted(static_cast<int>(i))), glossOfTexel, ofTexel);
    for (int c = 0; c < 3; ++c) shared[static_cast<std::size_t>(c)] = color[c];
    if (hasGloss()) std::ranges::copy(lobes[i].numbers(), shared.begin() + 3);
    std::ranges::copy(ofTexel, shared.begin() + static_cast<std::ptrdiff_t>(firstWeight_));
  }
}

// The colour that, times the luminance, comes closest to the samples without gloss (of each; may be
// empty) and their hue's change.
glm::vec3 LoomFitter::baseColor(std::span<const glm::vec3> samples, std::span<const float> gloss,
                                std::span<const float> weights) const {
  glm::dvec3 products(0.0);
  double squares = 0.0;
  for (std::size_t pair = 0; pair < samples.size(); ++pair) {
    const float* terms = terms_.data() + pair * components_;
    float y = 0.0f;
    for (std::size_t k = 0; k < components_; ++k) y += weights[k] * terms[k];
    const float* hue = hues_.data() + pair * kHueNumbers;
    const float weight = squaredWeight(luminance(samples[pair])) * y;
    const float shining = gloss.empty() ? 0.0f : gloss[pair];
    products += glm::dvec3(weight * (samples[pair] - shining - hueOf(hue, weights)));
    squares += double{weight} * double{y};
  }
  return roundedColor(squares > 0.0 ? glm::vec3(products / squares) : glm::vec3(1.0f));
}

std::vector<FieldLevel> LoomFitter::levels(FieldLevel finest) const {
  const auto ofWeights = [&](FieldLevel level) {
    return loomLevels(std::move(level), gram_, roundedWeight, roundedColor);
  };
  return hasGloss() ? glossLevels(finest, ofWeights) : ofWeights(std::move(finest));
}

}  // namespace weft
