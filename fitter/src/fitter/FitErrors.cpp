#include "weft/fitter/FitErrors.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

void addSums(ErrorSums& luminanceSums, ErrorSums& rgbSums, glm::vec3 data, glm::vec3 model) {
  const double luminanceError = luminance(data) - luminance(model);
  luminanceSums.absolute += std::abs(luminanceError);
  luminanceSums.squared += luminanceError * luminanceError;
  for (int channel = 0; channel < 3; ++channel) {
    const double error = data[channel] - model[channel];
    rgbSums.absolute += std::abs(error) / 3.0;
    rgbSums.squared += error * error / 3.0;
  }
}

ErrorStatistics statisticsOf(std::span<const TexelErrors> texels, std::size_t space, std::size_t measure,
                             double peak) {
  std::vector<double> epsilon;
  double squared = 0.0;
  double pairs = 0.0;
  for (const TexelErrors& texel : texels) {
    epsilon.push_back(texel.sums[space][measure].absolute / static_cast<double>(texel.pairs));
    squared += texel.sums[space][measure].squared;
    pairs += static_cast<double>(texel.pairs);
  }
  ErrorStatistics result;
  for (double value : epsilon) result.average += value / static_cast<double>(epsilon.size());
  std::sort(epsilon.begin(), epsilon.end());
  result.minimum = epsilon.front();
  result.maximum = epsilon.back();
  result.percentile95 = epsilon[(epsilon.size() - 1) * 95 / 100];
  result.rootMeanSquare = std::sqrt(squared / pairs);
  result.psnr = 20.0 * std::log10(peak / result.rootMeanSquare);
  return result;
}

}  // namespace

void TexelErrors::add(glm::vec3 data, glm::vec3 model, Encoding encoding, bool isGrazing) {
  const glm::vec3 storedData = encode(encoding, data);
  const glm::vec3 storedModel = encode(encoding, model);
  addSums(sums[0][0], sums[0][1], storedData, storedModel);
  addSums(sums[1][0], sums[1][1], data, model);
  ++pairs;
  if (isGrazing) {
    grazingAbsolute += std::abs(luminance(storedData) - luminance(storedModel));
    ++grazingPairs;
  }
  peak = std::max({peak, data.x, data.y, data.z});
}

FitErrors summarize(std::span<const TexelErrors> texels) {
  FitErrors errors;
  errors.texels = texels.size();
  if (texels.empty()) return errors;
  double grazing = 0.0;
  double grazingPairs = 0.0;
  float peak = 0.0f;
  for (const TexelErrors& texel : texels) {
    grazing += texel.grazingAbsolute;
    grazingPairs += static_cast<double>(texel.grazingPairs);
    peak = std::max(peak, texel.peak);
  }
  if (grazingPairs > 0.0) errors.grazing = grazing / grazingPairs;
  if (peak > 0.0f) errors.psnrPeak[1] = peak;
  for (std::size_t space = 0; space < 2; ++space)
    for (std::size_t measure = 0; measure < 2; ++measure)
      errors.statistics[space][measure] = statisticsOf(texels, space, measure, errors.psnrPeak[space]);
  return errors;
}

std::string toJson(const FitErrors& errors) {
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
  return json.dump();
}

}  // namespace weft
