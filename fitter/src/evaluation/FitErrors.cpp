#include "weft/evaluation/FitErrors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "weft/core/Color.h"
#include "weft/core/CpuVersions.h"

namespace weft {
namespace {

// Sums over some pairs; floats suffice for the pairs of one view.
struct SpaceSums {
  float luminance = 0.0f, squaredLuminance = 0.0f, rgb = 0.0f, squaredRgb = 0.0f;
};

WEFT_CPU_VERSIONS
SpaceSums sumsOf(std::span<const glm::vec3> data, std::span<const glm::vec3> model) {
  float luminanceSum = 0.0f;
  float squaredLuminance = 0.0f;
  float rgb = 0.0f;
  float squaredRgb = 0.0f;
#pragma omp simd reduction(+ : luminanceSum, squaredLuminance, rgb, squaredRgb)
  for (std::size_t i = 0; i < data.size(); ++i) {
    const float red = data[i].x - model[i].x;
    const float green = data[i].y - model[i].y;
    const float blue = data[i].z - model[i].z;
    const float y = kLuminanceWeights.x * red + kLuminanceWeights.y * green + kLuminanceWeights.z * blue;
    luminanceSum += std::abs(y);
    squaredLuminance += y * y;
    rgb += std::abs(red) + std::abs(green) + std::abs(blue);
    squaredRgb += red * red + green * green + blue * blue;
  }
  return {luminanceSum, squaredLuminance, rgb / 3.0f, squaredRgb / 3.0f};
}

WEFT_CPU_VERSIONS
float largestOf(std::span<const glm::vec3> colors) {
  float largest = 0.0f;
#pragma omp simd reduction(max : largest)
  for (std::size_t i = 0; i < colors.size(); ++i)
    largest = std::max(largest, std::max(std::max(colors[i].x, colors[i].y), colors[i].z));
  return largest;
}

void addSums(std::array<ErrorSums, 2>& to, const SpaceSums& sums) {
  to[0].absolute += sums.luminance;
  to[0].squared += sums.squaredLuminance;
  to[1].absolute += sums.rgb;
  to[1].squared += sums.squaredRgb;
}

ErrorStatistics statisticsOf(std::span<const TexelErrors> texels, std::size_t space, std::size_t measure,
                             double peak) {
  std::vector<double> epsilon;
  epsilon.reserve(texels.size());
  double squared = 0.0;
  double pairs = 0.0;
  for (const TexelErrors& texel : texels) {
    epsilon.push_back(double{texel.sums[space][measure].absolute} / static_cast<double>(texel.pairs));
    squared += double{texel.sums[space][measure].squared};
    pairs += static_cast<double>(texel.pairs);
  }
  ErrorStatistics result;
  for (double value : epsilon) result.average += value / static_cast<double>(epsilon.size());
  const auto [minimum, maximum] = std::ranges::minmax(epsilon);
  result.minimum = minimum;
  result.maximum = maximum;
  const auto percentile95 = epsilon.begin() + static_cast<std::ptrdiff_t>((epsilon.size() - 1) * 95 / 100);
  std::ranges::nth_element(epsilon, percentile95);
  result.percentile95 = *percentile95;
  result.rootMeanSquare = std::sqrt(squared / pairs);
  result.psnr = 20.0 * std::log10(peak / result.rootMeanSquare);
  return result;
}

}  // namespace

void TexelErrors::add(const PairValues& data, const PairValues& model, bool isGrazing) {
  const SpaceSums stored = sumsOf(data.stored, model.stored);
  addSums(sums[0], stored);
  addSums(sums[1], sumsOf(data.linear, model.linear));
  pairs += static_cast<std::uint32_t>(data.linear.size());
  if (isGrazing) {
    grazingAbsolute += stored.luminance;
    grazingPairs += static_cast<std::uint32_t>(data.linear.size());
  }
  peak = std::max(peak, largestOf(data.linear));
}

FitErrors summarize(std::span<const TexelErrors> texels) {
  FitErrors errors;
  errors.texels = texels.size();
  if (texels.empty()) return errors;
  double grazing = 0.0;
  double grazingPairs = 0.0;
  double peak = 0.0;
  for (const TexelErrors& texel : texels) {
    grazing += double{texel.grazingAbsolute};
    grazingPairs += static_cast<double>(texel.grazingPairs);
    peak = std::max(peak, double{texel.peak});
  }
  if (grazingPairs > 0.0) errors.grazing = grazing / grazingPairs;
  if (peak > 0.0) errors.psnrPeak[1] = peak;
  for (std::size_t space = 0; space < 2; ++space)
    for (std::size_t measure = 0; measure < 2; ++measure)
      errors.statistics[space][measure] = statisticsOf(texels, space, measure, errors.psnrPeak[space]);
  return errors;
}

namespace {

nlohmann::ordered_json jsonOf(const FitErrors& errors) {
  nlohmann::ordered_json json;
  constexpr std::array spaces{"stored", "linear"};
  constexpr std::array measures{"luminance", "rgb"};
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t m = 0; m < 2; ++m) {
      const ErrorStatistics& of = errors.statistics[s][m];
      json["epsilon"][spaces[s]][measures[m]] = {
          {"avg", of.average}, {"min", of.minimum}, {"max", of.maximum}, {"p95", of.percentile95}};
      json["rmse"][spaces[s]][measures[m]] = of.rootMeanSquare;
      json["psnr"][spaces[s]][measures[m]] = of.psnr;
    }
    json["psnr_peak"][spaces[s]] = errors.psnrPeak[s];
  }
  json["epsilon"]["grazing"]["stored"]["luminance"] = errors.grazing;
  json["texels"] = errors.texels;
  return json;
}

}  // namespace

std::string toJson(const FitErrors& errors, const std::optional<FitErrors>& heldOut) {
  nlohmann::ordered_json json = jsonOf(errors);
  json["held_out"] = heldOut ? jsonOf(*heldOut) : nlohmann::ordered_json();
  return json.dump();
}

std::string toText(const std::string& title, const FitErrors& errors) {
  std::string text =
      fmt::format("{:<18} {:>8} {:>8} {:>8} {:>8} {:>8}\n", title, "avg", "min", "max", "95 %", "rmse");
  for (const auto& [label, space, measure] :
       {std::tuple("stored luminance", ErrorSpace::Stored, ErrorMeasure::Luminance),
        std::tuple("stored RGB", ErrorSpace::Stored, ErrorMeasure::Rgb),
        std::tuple("linear luminance", ErrorSpace::Linear, ErrorMeasure::Luminance),
        std::tuple("linear RGB", ErrorSpace::Linear, ErrorMeasure::Rgb)}) {
    const ErrorStatistics& s = errors.of(space, measure);
    text += fmt::format("{:<18} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f}\n", label, s.average, s.minimum,
                        s.maximum, s.percentile95, s.rootMeanSquare);
  }
  return text;
}

}  // namespace weft
