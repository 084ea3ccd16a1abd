#include "weft/reflectance/LodModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "weft/core/Color.h"
#include "weft/core/Contract.h"
#include "weft/core/CpuVersions.h"
#include "weft/reflectance/LightMap.h"

namespace weft {
namespace {

void appendNumbered(std::vector<std::string>& names, const char* name, int count) {
  for (int i = 0; i < count; ++i) names.push_back(fmt::format("{}{}", name, i));
}

// Some texels of a row.
void appendTexels(std::vector<float>& numbers, const FloatImage& image, int first, int row, int count) {
  for (int i = 0; i < count; ++i) {
    const std::span<const float> texel = image.texel(first + i, row);
    numbers.insert(numbers.end(), texel.begin(), texel.end());
  }
}

/// Where Y, Cb and Cr lie among the components of a level, and how many each has.
struct ChannelRange {
  std::size_t first, count;
};
std::array<ChannelRange, 3> channelRanges(const LodModel& model) {
  const auto y = static_cast<std::size_t>(model.components());
  const auto chroma = static_cast<std::size_t>(model.chroma());
  return {{{0, y}, {y, chroma}, {y + chroma, chroma}}};
}

/// Calls of(from, to) for every number of all levels: its place when levels follow one another, and
/// that when all of Y come first, then all of Cb, then all of Cr.
template <class Function>
void forEachNumber(const LodModel& model, Function of) {
  const auto numbers = static_cast<std::size_t>(model.numbersOfLevel());
  std::size_t to = 0;
  for (const ChannelRange range : channelRanges(model))
    for (std::size_t level = 0; level < static_cast<std::size_t>(model.summedLevels()); ++level)
      for (std::size_t i = 0; i < range.count; ++i) of(level * numbers + range.first + i, to++);
}

[[gnu::always_inline]] inline float sumOfProducts(const float* a, const float* b, std::size_t count) {
  float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

// Y, Cb and Cr of some lights, of numbers with all of Y first.
WEFT_CPU_VERSIONS
void addSums(const float* weights, const float* sampled, std::size_t ofY, std::size_t ofChroma,
             std::span<glm::vec3> sums) {
  const std::size_t all = ofY + 2 * ofChroma;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float* of = sampled + i * all;
    sums[i].x += sumOfProducts(weights, of, ofY);
    sums[i].y += sumOfProducts(weights + ofY, of + ofY, ofChroma);
    sums[i].z += sumOfProducts(weights + ofY + ofChroma, of + ofY + ofChroma, ofChroma);
  }
}

}  // namespace

glm::vec3 yCbCrFromRgb(glm::vec3 rgb) {
  const float y = 0.299f * rgb.r + 0.587f * rgb.g + 0.114f * rgb.b;
  return {y, (rgb.b - y) / 1.772f, (rgb.r - y) / 1.402f};
}

glm::vec3 rgbFromYCbCr(glm::vec3 yCbCr) {
  const float r = yCbCr.x + 1.402f * yCbCr.z, b = yCbCr.x + 1.772f * yCbCr.y;
  return {r, (yCbCr.x - 0.299f * r - 0.114f * b) / 0.587f, b};
}

ModelType LodModel::type() {
  return {"lod",
          "A Laplacian pyramid whose levels are weights times components: fewer levels and less work "
          "from afar.",
          {ModelOption::number("components", "how many of Y a level, a multiple of 4", 8, 4, 64),
           ModelOption::number("chroma", "how many of Cb and of Cr, even", 2, 2, 16)},
          [](ModelOptions options) -> Result<std::shared_ptr<const ReflectanceModel>> {
            if (const int count = options.number("components"); count % 4 != 0)
              return fail(fmt::format("lod cannot have {} components", count), {}, "a multiple of 4");
            if (const int count = options.number("chroma"); count % 2 != 0)
              return fail(fmt::format("lod cannot have {} components of chroma", count), {},
                          "an even number");
            return std::make_shared<const LodModel>(std::move(options));
          }};
}

std::vector<std::string> LodModel::sharedParameters() const {
  std::vector<std::string> names;
  appendNumbered(names, "Y", components());
  appendNumbered(names, "Cb", chroma());
  appendNumbered(names, "Cr", chroma());
  return names;
}

std::vector<ModelTable> LodModel::tables() const {
  return {{.name = "eigen_brdfs", .channels = sharedParameters(), .isFiltered = true},
          {.name = "mean",
           .channels = {"ka", "kd", "ks", "exponent", "Cb", "Cr", "levels"},
           .width = 1,
           .height = 1},
          {.name = "light_polynomials", .channels = sharedParameters(), .width = kTerms},
          {.name = "mean_polynomials", .channels = {"Y"}, .width = kTerms}};
}

Result<std::shared_ptr<const ReflectanceModel>> LodModel::bind(
    std::shared_ptr<const FieldTables> tables) const {
  const FloatImage& maps = tables->at("eigen_brdfs");
  auto bound = std::make_shared<LodModel>(options());
  const std::span<const float> mean = tables->at("mean").texel(0, 0);
  bound->mean_ = {mean[Ambient], mean[Diffuse], mean[Specular], mean[Exponent]};
  bound->meanChroma_ = {mean[MeanCb], mean[MeanCr]};
  const float levels = mean[Levels];
  if (!(levels >= 1.0f && levels <= kMostLevels && levels == std::floor(levels)))
    return fail(fmt::format("a pyramid of {} levels", levels));
  if (!(bound->mean_.exponent >= 0.0f))
    return fail(fmt::format("a mean with the exponent {}", bound->mean_.exponent));
  bound->levels_ = static_cast<int>(levels);
  bound->mapSize_ = maps.height() / bound->levels_;
  const int size = bound->mapSize_;
  if (size < 1 || maps.height() != size * bound->levels_ || maps.width() % size != 0)
    return fail(fmt::format("maps of {} levels of {} x {} texels", levels, maps.width(), maps.height()));
  const int views = maps.width() / size;
  const FloatImage& polynomials = tables->at("light_polynomials");
  const FloatImage& ofMean = tables->at("mean_polynomials");
  if (polynomials.height() != views * bound->levels_ || ofMean.height() != views)
    return fail(fmt::format("polynomials of {} and {} maps, of {} views and {} levels", ofMean.height(),
                            polynomials.height(), views, levels));
  for (int view = 0; view < views; ++view) {
    std::vector<float>& layer = bound->layers_.emplace_back();
    for (int y = 0; y < maps.height(); ++y) appendTexels(layer, maps, view * size, y, size);
    for (int level = 0; level < bound->levels_; ++level)
      appendTexels(layer, polynomials, 0, level * views + view, kTerms);
    appendTexels(layer, ofMean, 0, view, kTerms);
  }
  return bound;
}

std::span<const float> LodModel::commonLayer(int layer) const {
  return layer < std::ssize(layers_) ? std::span<const float>(layers_[static_cast<std::size_t>(layer)])
                                     : std::span<const float>();
}

std::vector<float> LodModel::sampledLayer(std::span<const float> layer,
                                          std::span<const glm::vec3> lights) const {
  const auto numbers = static_cast<std::size_t>(numbersOfLevel());
  const std::size_t texels = static_cast<std::size_t>(mapSize_) * static_cast<std::size_t>(mapSize_);
  const std::size_t all = static_cast<std::size_t>(levels_) * numbers;
  std::vector<float> sampled(lights.size() * all);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightMapTexels found = lightMapTexels(lights[i], mapSize_);
    forEachNumber(*this, [&](std::size_t from, std::size_t to) {
      const std::size_t level = from / numbers, number = from % numbers;
      for (int corner = 0; corner < 4; ++corner) {
        const std::size_t texel = level * texels + static_cast<std::size_t>(found.index[corner]);
        sampled[i * all + to] += found.weight[corner] * layer[texel * numbers + number];
      }
    });
  }
  return sampled;
}

void LodModel::evaluateSampled(std::span<const float> shared, std::span<const float> sampled,
                               std::span<const glm::vec3> lights, glm::vec3 view,
                               std::span<glm::vec3> colors) const {
  const auto levels = static_cast<std::size_t>(levels_);
  const std::size_t all = levels * static_cast<std::size_t>(numbersOfLevel());
  WEFT_EXPECT(shared.size() == 3 + all, "a texel has the numbers of all levels");
  WEFT_EXPECT(sampled.size() == colors.size() * all && lights.size() == colors.size(),
              "a sampled layer has numbers for every light");
  std::vector<float> weights(all);
  forEachNumber(*this, [&](std::size_t from, std::size_t to) { weights[to] = shared[3 + from]; });
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = {mean_.value(lights[i], view), meanChroma_};
  addSums(weights.data(), sampled.data(), levels * static_cast<std::size_t>(components()),
          levels * static_cast<std::size_t>(chroma()), colors);
  for (glm::vec3& color : colors) color = glm::max(rgbFromYCbCr(color), 0.0f);
}

void LodModel::evaluateColors(std::span<const float> shared, std::span<const float> layer,
                              std::span<const glm::vec3> lights, glm::vec3 view,
                              std::span<glm::vec3> colors) const {
  evaluateSampled(shared, sampledLayer(layer, lights), lights, view, colors);
}

glm::vec3 LodModel::evaluateColor(std::span<const float> shared, std::span<const float> layer,
                                  glm::vec3 light, glm::vec3 view) const {
  glm::vec3 color;
  evaluateColors(shared, layer, {&light, 1}, view, {&color, 1});
  return color;
}

// Light of each colour is integrated for itself: what a component reflects of red light is red.
glm::vec3 LodModel::colorUnderEnvironment(std::span<const float> shared, std::span<const float> layer,
                                          glm::vec3, const EnvironmentIntegrals& light) const {
  const std::array<glm::vec3, kTerms> moments = light.moments();
  const auto numbers = static_cast<std::size_t>(numbersOfLevel()), levels = static_cast<std::size_t>(levels_);
  WEFT_EXPECT(shared.size() == 3 + levels * numbers, "a texel has the numbers of all levels");
  const std::span<const float> ofMean = layer.last(kTerms);
  const std::span<const float> polynomials = layer.last(kTerms + levels * kTerms * numbers);
  glm::vec3 color(0.0f);
  for (std::size_t term = 0; term < kTerms; ++term) {
    // Y, Cb, Cr; the last term is 1
    glm::vec3 factors(ofMean[term], term + 1 == kTerms ? meanChroma_ : glm::vec2(0.0f));
    for (std::size_t level = 0; level < levels; ++level)
      for (int c = 0; c < 3; ++c) {
        const ChannelRange range = channelRanges(*this)[static_cast<std::size_t>(c)];
        factors[c] +=
            sumOfProducts(shared.data() + 3 + level * numbers + range.first,
                          polynomials.data() + (level * kTerms + term) * numbers + range.first, range.count);
      }
    color += rgbFromYCbCr(factors) * moments[term];
  }
  return glm::max(color, 0.0f);
}

float LodModel::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                         glm::vec3 view) const {
  return luminance(evaluateColor(shared, layer, light, view));
}

std::map<std::string, std::string> LodModel::shaderDefines() const {
  return {{"COMPONENTS", std::to_string(components())},
          {"CHROMA", std::to_string(chroma())},
          {"LEVELS", std::to_string(levels_)},
          {"MODEL_GIVES_COLOR", ""}};
}

}  // namespace weft
