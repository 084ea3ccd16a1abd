#include "weft/reflectance/LoomModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "weft/core/Color.h"
#include "weft/core/Contract.h"
#include "weft/core/CpuVersions.h"
#include "weft/reflectance/LightMap.h"

namespace weft {
namespace {

std::vector<std::string> numbered(const char* name, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(fmt::format("{}{}", name, i));
  return names;
}

glm::vec3 hueOf(float red, float blue) {
  return {red, -(kLuminanceWeights.r * red + kLuminanceWeights.b * blue) / kLuminanceWeights.g, blue};
}

// What a sampled layer gives of one light: numbers of M, then of C.
[[gnu::always_inline]] inline glm::vec3 colorOf(const float* weights, int components, glm::vec3 baseColor,
                                                const float* m, float gloss) {
  float y = 0.0f;
#pragma omp simd reduction(+ : y)
  for (int k = 0; k < components; ++k) y += weights[k] * m[k];
  const float* c = m + components;
  const glm::vec3 hue = hueOf(weights[0] * c[0] + weights[1] * c[1], weights[0] * c[2] + weights[1] * c[3]);
  return glm::max(y * baseColor + hue + gloss, 0.0f);
}

// `colors` holds what shines at first.
WEFT_CPU_VERSIONS
void colorsOf(const float* weights, int components, glm::vec3 baseColor, const float* sampled,
              std::span<glm::vec3> colors) {
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = colorOf(weights, components, baseColor,
                        sampled + i * static_cast<std::size_t>(components + 4), colors[i].x);
}

Registration registrationFrom(const FloatImage& table) {
  Registration registration{.height = table.at(0, 0, 2), .deviations = {}};
  for (int view = 0; view < table.width(); ++view)
    registration.deviations.emplace_back(table.at(view, 0, 0), table.at(view, 0, 1));
  return registration;
}

}  // namespace

std::vector<ModelType> LoomModel::types() {
  const std::vector<ModelOption> options{
      ModelOption::number("components", "how many components, a multiple of 4", 48, 4, 128)};
  const auto make = [](ModelOptions chosen,
                       bool hasGloss) -> Result<std::shared_ptr<const ReflectanceModel>> {
    if (const int count = chosen.number("components"); count % 4 != 0)
      return fail(fmt::format("loom cannot have {} components", count), {}, "a multiple of 4");
    return std::make_shared<const LoomModel>(std::move(chosen), hasGloss);
  };
  return {{"loom",
           "Weights of a texel times components that all texels share, registered for relief: small, "
           "with its hue and coarser levels.",
           options, [make](ModelOptions chosen) { return make(std::move(chosen), false); }},
          {"loom_gloss", "loom with a lobe a texel for what shines.", options,
           [make](ModelOptions chosen) { return make(std::move(chosen), true); }}};
}

std::vector<std::string> LoomModel::sharedParameters() const {
  std::vector<std::string> names = numbered("W", components());
  if (hasGloss_) names.insert(names.begin(), {"gloss_x", "gloss_y", "gloss_roughness", "gloss_amount"});
  return names;
}

std::vector<ModelTable> LoomModel::tables() const {
  std::vector<std::string> channels = numbered("M", components());
  for (const char* name : {"red0", "red1", "blue0", "blue1"}) channels.emplace_back(name);
  return {{.name = "light_maps", .channels = channels, .isFiltered = true},
          {.name = "light_polynomials", .channels = channels, .width = kTerms},
          {.name = "registration", .channels = {"deviation_x", "deviation_y", "height"}, .height = 1}};
}

Result<std::shared_ptr<const ReflectanceModel>> LoomModel::bind(
    std::shared_ptr<const FieldTables> tables) const {
  const FloatImage& maps = tables->at("light_maps");
  const FloatImage& polynomials = tables->at("light_polynomials");
  const FloatImage& registration = tables->at("registration");
  const int size = maps.height(), views = registration.width();
  if (maps.width() != size * views)
    return fail(
        fmt::format("the light maps of {} views are {} texels high and {} wide", views, size, maps.width()));
  if (polynomials.height() != views)
    return fail(fmt::format("there are polynomials of {} views, of {}", polynomials.height(), views));
  auto bound = std::make_shared<LoomModel>(options(), hasGloss_);
  bound->registration_ = registrationFrom(registration);
  bound->mapSize_ = size;
  bound->layers_.resize(static_cast<std::size_t>(views));
  for (int view = 0; view < views; ++view) {
    std::vector<float>& layer = bound->layers_[static_cast<std::size_t>(view)];
    const auto append = [&](std::span<const float> texel) {
      layer.insert(layer.end(), texel.begin(), texel.end());
    };
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) append(maps.texel(view * size + x, y));
    for (int term = 0; term < kTerms; ++term) append(polynomials.texel(term, view));
  }
  return bound;
}

std::span<const float> LoomModel::commonLayer(int layer) const {
  return layer < std::ssize(layers_) ? std::span<const float>(layers_[static_cast<std::size_t>(layer)])
                                     : std::span<const float>();
}

std::vector<float> LoomModel::sampledLayer(std::span<const float> layer,
                                           std::span<const glm::vec3> lights) const {
  const auto channels = static_cast<std::size_t>(mapChannels());
  std::vector<float> sampled(lights.size() * channels);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightMapTexels texels = lightMapTexels(lights[i], mapSize_);
    for (int corner = 0; corner < 4; ++corner)
      for (std::size_t c = 0; c < channels; ++c)
        sampled[i * channels + c] +=
            texels.weight[corner] * layer[static_cast<std::size_t>(texels.index[corner]) * channels + c];
  }
  return sampled;
}

void LoomModel::evaluateSampled(std::span<const float> shared, std::span<const float> sampled,
                                std::span<const glm::vec3> lights, glm::vec3 view,
                                std::span<glm::vec3> colors) const {
  WEFT_EXPECT(shared.size() == firstWeight() + static_cast<std::size_t>(components()),
              "a texel has as many numbers as its model");
  WEFT_EXPECT(sampled.size() == colors.size() * static_cast<std::size_t>(mapChannels()),
              "a sampled layer has numbers for every light");
  std::ranges::fill(colors, glm::vec3(0.0f));
  if (hasGloss_) {
    const GlossLobe lobe = GlossLobe::from(shared.subspan(3));
    for (std::size_t i = 0; i < colors.size(); ++i) colors[i].x = lobe.evaluate(lights[i], view);
  }
  colorsOf(shared.data() + firstWeight(), components(), {shared[0], shared[1], shared[2]}, sampled.data(),
           colors);
}

glm::vec3 LoomModel::evaluateColor(std::span<const float> shared, std::span<const float> layer,
                                   glm::vec3 light, glm::vec3 view) const {
  glm::vec3 color;
  evaluateColors(shared, layer, {&light, 1}, view, {&color, 1});
  return color;
}

void LoomModel::evaluateColors(std::span<const float> shared, std::span<const float> layer,
                               std::span<const glm::vec3> lights, glm::vec3 view,
                               std::span<glm::vec3> colors) const {
  evaluateSampled(shared, sampledLayer(layer, lights), lights, view, colors);
}

// Light of each colour is integrated for itself: what a component reflects of red light is red.
glm::vec3 LoomModel::colorUnderEnvironment(std::span<const float> shared, std::span<const float> layer,
                                           glm::vec3 view, const EnvironmentIntegrals& light) const {
  const std::array<glm::vec3, kTerms> moments = light.moments();
  const int count = components();
  const auto channels = static_cast<std::size_t>(mapChannels());
  const std::span<const float> polynomials = layer.last(kTerms * channels);
  const std::span<const float> weights = shared.subspan(firstWeight());
  // of light of every colour, what a channel of the maps reflects
  const auto reflected = [&](int channel) {
    glm::vec3 sum(0.0f);
    for (int term = channel < kQuadratic || channel >= count ? 0 : 3; term < kTerms; ++term)
      sum += polynomials[static_cast<std::size_t>(term) * channels + static_cast<std::size_t>(channel)] *
             moments[static_cast<std::size_t>(term)];
    return sum;
  };
  glm::vec3 y(0.0f);
  for (int k = 0; k < count; ++k) y += weights[static_cast<std::size_t>(k)] * reflected(k);
  const glm::vec3 red = weights[0] * reflected(count) + weights[1] * reflected(count + 1);
  const glm::vec3 blue = weights[0] * reflected(count + 2) + weights[1] * reflected(count + 3);
  const glm::vec3 hue(red.r, hueOf(red.g, blue.g).g, blue.b);
  glm::vec3 color = y * glm::vec3(shared[0], shared[1], shared[2]) + hue;
  if (hasGloss_) {
    const GlossLobe lobe = GlossLobe::from(shared.subspan(3));
    // Without Fresnel's factor all is reflected.
    color += lobe.amount * light.glossy(lobe.normal(), view, std::sqrt(lobe.alpha), 1.0f);
  }
  return glm::max(color, 0.0f);
}

float LoomModel::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                          glm::vec3 view) const {
  const std::vector<float> sampled = sampledLayer(layer, {&light, 1});
  float y = hasGloss_ ? GlossLobe::from(shared).evaluate(light, view) : 0.0f;
  const std::span<const float> weights = shared.subspan(firstWeight() - 3);
  for (std::size_t k = 0; k < weights.size(); ++k) y += weights[k] * sampled[k];
  return std::max(y, 0.0f);
}

std::map<std::string, std::string> LoomModel::shaderDefines() const {
  std::map<std::string, std::string> defines{{"COMPONENTS", std::to_string(components())},
                                             {"QUADRATIC", std::to_string(kQuadratic)},
                                             {"MODEL_GIVES_COLOR", ""}};
  if (hasGloss_) defines["GLOSS"] = "";
  return defines;
}

}  // namespace weft
