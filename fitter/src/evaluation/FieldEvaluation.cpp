#include "weft/evaluation/FieldEvaluation.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "weft/core/Direction.h"

namespace weft {
namespace {

/// Pairs that show most of what there is to see: light along and across the view, high and low.
struct ShownPair {
  std::size_t view, light;
  std::size_t pair;  ///< index among all
};

std::vector<ShownPair> shownPairs(const BtfDescription& measured) {
  std::vector<ShownPair> pairs;
  for (const auto& [view, light] : {std::pair(directionFromDegrees(0, 0), directionFromDegrees(45, 180)),
                                    std::pair(directionFromDegrees(45, 0), directionFromDegrees(30, 90)),
                                    std::pair(directionFromDegrees(75, 0), directionFromDegrees(60, 180))}) {
    const std::size_t nearestView = nearestDirection(measured.views, view);
    const std::size_t nearestLight = nearestDirection(measured.lights, light);
    pairs.push_back({nearestView, nearestLight, nearestView * measured.lights.size() + nearestLight});
  }
  return pairs;
}

void put(FloatImage& image, int x, int y, glm::vec3 rgb) {
  for (int channel = 0; channel < 3; ++channel) image.at(x, y, channel) = rgb[channel];
}

/// Eps of stored luminance as the fit reported it.
std::optional<double> reportedError(const ReflectanceFieldDescription& field) {
  const nlohmann::json report = nlohmann::json::parse(field.fitReport, nullptr, false);
  const nlohmann::json::json_pointer average("/epsilon/stored/luminance/avg");
  if (!report.contains(average) || !report.at(average).is_number()) return std::nullopt;
  return report.at(average).get<double>();
}

// Names alone prove nothing: files are renamed, and others get their names.
std::optional<std::string> otherMeasurement(const ReflectanceFieldDescription& field,
                                            const BtfDescription& measured, const FitErrors& errors) {
  constexpr double kRounding = 1e-3;  // of other processors
  const double now = errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance).average;
  const std::optional<double> then = reportedError(field);
  if (then ? std::abs(now - *then) <= kRounding * *then : measured.name == field.source) return std::nullopt;
  std::string text =
      measured.name == field.source
          ? fmt::format("{} is not what was fitted, or not those texels", measured.name)
          : fmt::format("{} is not what was fitted, which was {}", measured.name, field.source);
  if (then) text += fmt::format(": eps of stored luminance was {:.4f} then and is {:.4f} now", *then, now);
  return text;
}

void compareRun(const ReflectanceField& field, const ErrorMeter& meter, TexelRun& run,
                const std::vector<ShownPair>& shown, FieldEvaluation& evaluation) {
  const std::size_t first = static_cast<std::size_t>(run.y()) * static_cast<std::size_t>(field.width()) +
                            static_cast<std::size_t>(run.x());
  meter.measure(field, run,
                std::span(evaluation.texels).subspan(first, static_cast<std::size_t>(run.size())));
  for (int x = run.x(); x < run.x() + run.size(); ++x)
    for (std::size_t k = 0; k < shown.size(); ++k) {
      PairPictures& pair = evaluation.pairs[k];
      put(pair.measured, x, run.y(), run.measured(x - run.x()).linear[shown[k].pair]);
      put(pair.model, x, run.y(), field.evaluate(x, run.y(), pair.light, pair.view));
    }
}

}  // namespace

Result<FieldEvaluation> evaluateField(const ReflectanceField& field, const BtfSource& source,
                                      const std::optional<Crop>& wanted, std::size_t memory,
                                      const Progress& progress) {
  const BtfDescription& measured = source.description();
  WEFT_TRY(const Crop crop, checkedCrop(wanted, measured));
  if (crop.width != field.width() || crop.height != field.height())
    return fail(fmt::format("the field has {} x {} texels and the measurement {} x {}", field.width(),
                            field.height(), crop.width, crop.height),
                measured.name, "name the texels that were fitted: --crop");
  const ErrorMeter meter(field.formula(), FittedPairs(field.description(), measured), measured);
  FieldEvaluation evaluation;
  evaluation.texels.resize(static_cast<std::size_t>(crop.width) * static_cast<std::size_t>(crop.height));
  const std::vector<ShownPair> shown = shownPairs(measured);
  for (const ShownPair pair : shown)
    evaluation.pairs.push_back({measured.views[pair.view], measured.lights[pair.light],
                                FloatImage(crop.width, crop.height, {"R", "G", "B"}),
                                FloatImage(crop.width, crop.height, {"R", "G", "B"})});

  const int rowsAtOnce = std::min(source.rowsWithin(memory), crop.height);
  SampleWindow window;
  for (int first = 0; first < crop.height; first += rowsAtOnce) {
    const int count = std::min(rowsAtOnce, crop.height - first);
    WEFT_TRY_VOID(window.read(source, crop, first, count, 0));
    tbb::parallel_for(0, count, [&](int i) {
      const SampledRow row{window, measured, meter.pairs(), crop, first + i};
      tbb::parallel_for(0, TexelRun::runsIn(crop.width), [&](int number) {
        TexelRun run(row, number);
        compareRun(field, meter, run, shown, evaluation);
      });
    });
    if (progress) progress(static_cast<double>(first + count) / crop.height);
  }
  evaluation.errors = summarize(evaluation.texels, &SplitErrors::fitted);
  if (meter.pairs().holdOut()) evaluation.heldOut = summarize(evaluation.texels, &SplitErrors::heldOut);
  evaluation.warning = otherMeasurement(field.description(), measured, evaluation.errors);
  return evaluation;
}

FloatImage errorMap(const std::vector<SplitErrors>& texels, int width, int height) {
  FloatImage map(width, height, {"eps"});
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const TexelErrors& fitted = texels[i].fitted;
    map.values()[i] = fitted.sums[0][0].absolute / std::max(static_cast<float>(fitted.pairs), 1.0f);
  }
  return map;
}

}  // namespace weft
