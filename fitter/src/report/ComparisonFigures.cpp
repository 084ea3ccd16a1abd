#include "ComparisonFigures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <string_view>
#include <utility>

#include "weft/baking/ReferenceRenderer.h"
#include "weft/core/Direction.h"
#include "weft/evaluation/FieldEvaluation.h"
#include "weft/evaluation/TexelSamples.h"
#include "weft/io/ImageFile.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/report/FieldReport.h"

namespace weft {
namespace {

constexpr std::size_t kMemory = std::size_t{1} << 30;  // for the samples of one view

// --- One texel ---

/// Stored luminance of one texel over all pairs, `[view][light]`.
using Pairs = std::vector<float>;

Pairs storedLuminance(const std::vector<glm::vec3>& stored) {
  Pairs pairs;
  for (const glm::vec3 rgb : stored) pairs.push_back(luminance(rgb));
  return pairs;
}

Pairs pairsOf(const ReflectanceField& field, int x, int y, const BtfDescription& measured) {
  Pairs pairs;
  for (const glm::vec3 view : measured.views)
    for (const glm::vec3 light : measured.lights)
      pairs.push_back(luminance(encode(measured.encoding, field.evaluate(x, y, light, view))));
  return pairs;
}

struct NamedPairs {
  std::string name;
  Pairs pairs;
};

ReportPicture pairsPicture(const NamedPairs& texel, const BtfDescription& measured, float highest) {
  FloatImage image(static_cast<int>(measured.lights.size()), static_cast<int>(measured.views.size()),
                   {"value"});
  std::ranges::copy(texel.pairs, image.values().begin());
  const ColorScale scale{0.0f, highest, "stored luminance"};
  return {colorMapped(image, scale), texel.name, scale, 260};
}

/// The pairs of one view under all lights.
ReportPlot viewPlot(std::span<const NamedPairs> texels, const BtfDescription& measured, std::size_t view) {
  const glm::dvec2 angles = degreesFromDirection(measured.views[view]);
  ReportPlot plot{
      fmt::format("The same for view ({:.0f}°, {:.0f}°): lights from the pole outwards, ring by ring.",
                  angles.x, angles.y),
      "light",
      "stored luminance",
      {}};
  for (const NamedPairs& texel : texels) {
    PlotSeries series{
        texel.name, {}, &texel == texels.data() ? PlotSeries::Style::Dots : PlotSeries::Style::Line};
    for (std::size_t light = 0; light < measured.lights.size(); ++light)
      series.points.emplace_back(static_cast<double>(light),
                                 static_cast<double>(texel.pairs[view * measured.lights.size() + light]));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// --- The cloth ---

ReferenceMaterial material(int width, int height) {
  // About a texel a pixel, so that neither is lost.
  const float repetitions = std::max(1.0f, std::round(256.0f / static_cast<float>(std::max(width, height))));
  return {width, height, glm::vec2(repetitions), {}};
}

/// From the left and somewhat above.
constexpr glm::vec3 kSideLight{-0.55f, 0.45f, 0.7f};
/// Almost along the cloth.
constexpr glm::vec3 kLowLight{-0.5f, 0.85f, 0.3f};

ReferenceShot clothShot(int size, glm::vec3 light) {
  ReferenceShot shot;
  shot.eye = {0.9f, -0.6f, 2.9f};
  shot.verticalFieldOfView = 0.68f;
  shot.lights = {{ReferenceLight::Kind::Directional, light, glm::vec3(1.3f * std::numbers::pi_v<float>)}};
  shot.width = shot.height = size;
  shot.samples = 2;
  return shot;
}

/// The cloth of a RawBtf or a ReflectanceField.
template <class Surface>
FloatImage clothPicture(const ReferenceRenderer& renderer, const ReferenceShot& shot, const RawBtf& btf,
                        const Surface& surface) {
  ReferenceMaterial cloth = material(btf.description().width, btf.description().height);
  cloth.value = [&](int x, int y, glm::vec3 light, glm::vec3 view) {
    return surface.evaluate(x, y, light, view);
  };
  return renderer.render(shot, cloth);
}

/// The mean absolute difference of displayed RGB, 0..1, where there is cloth.
double displayedDifference(const FloatImage& a, const FloatImage& b) {
  double sum = 0.0, covered = 0.0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      if (a.at(x, y, 3) <= 0.0f) continue;
      covered += 3.0;
      for (int channel = 0; channel < 3; ++channel) {
        const auto shown = [&](const FloatImage& image) {
          return std::min(encode(Encoding::Srgb, image.at(x, y, channel)), 1.0f);
        };
        sum += static_cast<double>(std::abs(shown(a) - shown(b)));
      }
    }
  return covered > 0.0 ? sum / covered : 0.0;
}

// --- Single views ---

/// A spiral of directions as far from each other as from their neighbours, down to the lowest that
/// was measured.
std::vector<glm::vec3> evenLights(std::size_t count, float lowest) {
  std::vector<glm::vec3> lights;
  const float golden = std::numbers::pi_v<float> * (3.0f - std::sqrt(5.0f));
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<float>(i);
    const float z = 1.0f - (n + 0.5f) / static_cast<float>(count) * (1.0f - lowest);
    const float radius = std::sqrt(1.0f - z * z);
    lights.emplace_back(radius * std::cos(golden * n), radius * std::sin(golden * n), z);
  }
  return lights;
}

/// Errors over all pairs of a measurement, fitted or not.
Result<FitErrors> errorsAgainst(const ReflectanceField& field, const BtfSource& source) {
  WEFT_TRY(const FieldEvaluation evaluation, evaluateField(field, source, {}, kMemory));
  return evaluation.heldOut ? *evaluation.heldOut : evaluation.errors;
}

struct OneViewMethod {
  std::string label;
  ModelDescription model;
  bool resampled = false;
};

std::vector<OneViewMethod> oneViewMethods(bool withLaf) {
  std::vector<OneViewMethod> methods{{"ptm, luminance", {.name = "ptm"}},
                                     {"ptm, RGB", {.name = "ptm", .options = {{"color", "rgb"}}}}};
  if (!withLaf) return methods;
  methods.push_back({"laf, 2 lobes", {.name = "laf"}});
  methods.push_back({"laf, 2 lobes, interpolated lights", {.name = "laf"}, true});
  return methods;
}

Image texelsAt(int width, int height, const std::function<glm::vec3(int x, int y)>& value) {
  FloatImage image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 rgb = value(x, y);
      for (int channel = 0; channel < 3; ++channel) image.at(x, y, channel) = rgb[channel];
    }
  return *displayImage(image);
}

void addPapersSingleView(HtmlReport& report) {
  report.table(
      {"The paper's own table 2 ([Bosserhoff 2003] 2003), of one view of 256 x 256 texels, on an AMD at "
       "1.3 GHz.",
       {"what", "memory, MB", "fitting, s"},
       {{"BTF", "58", "-"},
        {"PTM-RGB", "6", "22"},
        {"PTM-Lum", "3", "15"},
        {"Lafortune-Lum, 2 lobes", "2.8", "112"}}});
}

std::string eps(const FitErrors& errors, ErrorSpace space) {
  return fmt::format("{:.4f}", errors.of(space, ErrorMeasure::Luminance).average);
}

/// All methods on one measured view: adds pictures under a light between the measured ones.
Result<std::vector<OneViewFit>> addSingleView(HtmlReport& report, const RawBtf& btf, glm::vec3 view,
                                              bool withLaf) {
  const BtfDescription& measured = btf.description();
  const std::vector<glm::vec3> between =
      evenLights(4 * measured.lights.size(), std::ranges::min(measured.lights, {}, &glm::vec3::z).z);
  const OneViewBtf asMeasured(btf, view, measured.lights);
  const OneViewBtf resampled(btf, view, between);
  const glm::vec3 shown = between[nearestDirection(between, directionFromDegrees(52, 35))];
  const auto pictureOf = [&](const auto& surface) {
    return texelsAt(measured.width, measured.height,
                    [&](int x, int y) { return surface.evaluate(x, y, shown, view); });
  };
  std::vector<ReportPicture> pictures{{pictureOf(btf), "The measurement, interpolated", {}, 220}};
  std::vector<OneViewFit> fits;
  for (const OneViewMethod& method : oneViewMethods(withLaf)) {
    FitOptions options;
    options.model = method.model;
    options.space = FitSpace::Stored;  // as the paper
    options.cosineInModel = true;
    WEFT_TRY(const FitResult fit, fitReflectanceField(method.resampled ? resampled : asMeasured, options));
    WEFT_TRY(FitErrors errors, errorsAgainst(fit.field, asMeasured));
    WEFT_TRY(FitErrors errorsBetween, errorsAgainst(fit.field, resampled));
    pictures.push_back({pictureOf(fit.field), method.label, {}, 220});
    fits.push_back({view, method.label, fit.secondsFitting, gpuBytes(fit.field), std::move(errors),
                    std::move(errorsBetween)});
  }
  const glm::dvec2 viewAngles = degreesFromDirection(view), lightAngles = degreesFromDirection(shown);
  report.paragraph(fmt::format(
      "View ({:.0f}°, {:.0f}°) under light from ({:.0f}°, {:.0f}°), which was not measured:", viewAngles.x,
      viewAngles.y, lightAngles.x, lightAngles.y));
  WEFT_TRY_VOID(report.pictures(pictures));
  return fits;
}

bool isAmong(std::span<const ComparedModel> models, std::string_view name) {
  return std::ranges::any_of(
      models, [&](const ComparedModel& m) { return m.fit.field.model().description().name == name; });
}

Result<void> addLowLightPictures(HtmlReport& report, const ReferenceRenderer& renderer, const RawBtf& btf,
                                 int size, std::span<const ComparedModel> models) {
  const ReferenceShot shot = clothShot(size, kLowLight);
  WEFT_TRY(Image shown, displayImage(clothPicture(renderer, shot, btf, btf)));
  std::vector<ReportPicture> pictures{{std::move(shown), "The measurement itself"}};
  for (const ComparedModel& model : models) {
    const std::string name = model.fit.field.model().description().name;
    if (name != "rfnl" && name != "bump") continue;
    WEFT_TRY(Image image, displayImage(clothPicture(renderer, shot, btf, model.fit.field)));
    pictures.push_back({std::move(image), model.label});
  }
  report.paragraph("Under low light, beside a bump-mapped surface (the paper's figure 4):");
  return report.pictures(pictures);
}

}  // namespace

Result<void> addErrorMaps(HtmlReport& report, std::span<const ComparedModel> models) {
  const int width = models.front().fit.field.width(), height = models.front().fit.field.height();
  double highest = 0.0;
  for (const ComparedModel& model : models)
    highest = std::max(highest, model.fit.errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance).maximum);
  const ColorScale scale{0.0f, static_cast<float>(highest), "eps"};
  std::vector<ReportPicture> maps;
  for (const ComparedModel& model : models)
    maps.push_back({colorMapped(errorMap(model.fit.texels, width, height), scale), model.label, scale, 220});
  report.paragraph("Where the errors are: eps of stored luminance, all on the same scale.");
  return report.pictures(maps);
}

void addSizePlot(HtmlReport& report, const RawBtf& btf, std::span<const ComparedModel> models) {
  ReportPlot plot{"Error against memory.", "bytes a texel on the GPU", "eps of stored luminance", {}, true};
  for (const ComparedModel& model : models)
    plot.series.push_back(
        {model.label,
         {{static_cast<double>(model.gpuBytes) / static_cast<double>(btf.description().texels()),
           model.fit.errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance).average}},
         PlotSeries::Style::Dots});
  report.plot(plot);
}

Result<void> addTexelFigure(HtmlReport& report, const RawBtf& btf, const FitOptions& options,
                            std::span<const ComparedModel> models) {
  const BtfDescription& measured = btf.description();
  const int x = measured.width / 2, y = measured.height / 2;
  std::vector<NamedPairs> texels{
      {"measured", storedLuminance(texelSamples(measured, {&btf.samples(), y, x}).stored)}};
  if (isAmong(models, "laf"))
    for (const int lobes : {2, 10}) {
      FitOptions ofTexel = options;
      ofTexel.model = {.name = "laf", .options = {{"lobes", lobes}}};
      ofTexel.crop = Crop{x, y, 1, 1};
      WEFT_TRY(const FitResult fit, fitReflectanceField(btf, ofTexel));
      texels.push_back({fit.field.model().options().label(), pairsOf(fit.field, 0, 0, measured)});
    }
  for (const ComparedModel& model : models)
    if (model.fit.field.model().layerDirections() == LayerDirections::Views)
      texels.push_back({model.label, pairsOf(model.fit.field, x, y, measured)});

  report.heading("One texel");
  report.paragraph(
      fmt::format("Texel ({}, {}): a row a view, a column a light, both from the pole outwards (the paper's "
                  "figure 1). The foreshortening "
                  "n.l is included.",
                  x, y));
  const float highest = *std::ranges::max_element(texels.front().pairs);
  std::vector<ReportPicture> pictures;
  for (const NamedPairs& texel : texels) pictures.push_back(pairsPicture(texel, measured, highest));
  WEFT_TRY_VOID(report.pictures(pictures));
  report.plot(viewPlot(texels, measured, nearestDirection(measured.views, directionFromDegrees(45, 0))));
  return {};
}

Result<void> addClothPictures(HtmlReport& report, const RawBtf& btf, int size,
                              std::span<ComparedModel> models) {
  WEFT_TRY(const ReferenceRenderer renderer, ReferenceRenderer::create(makeFoldedCloth()));
  const ReferenceShot shot = clothShot(size, kSideLight);
  const FloatImage measured = clothPicture(renderer, shot, btf, btf);
  WEFT_TRY(Image shown, displayImage(measured));
  std::vector<ReportPicture> pictures{{std::move(shown), "The measurement itself, nine pairs interpolated"}};
  for (ComparedModel& model : models) {
    const FloatImage picture = clothPicture(renderer, shot, btf, model.fit.field);
    model.pictureDifference = displayedDifference(measured, picture);
    WEFT_TRY(Image image, displayImage(picture));
    pictures.push_back(
        {std::move(image), fmt::format("{}: mean difference {:.4f}", model.label, model.pictureDifference)});
  }
  report.heading("On a cloth");
  report.paragraph(
      "A cloth with folds, ray-traced with shadows (the paper's figure 5). Differences are of displayed RGB, "
      "0 to 1, between the picture of the model and that of the measurement.");
  WEFT_TRY_VOID(report.pictures(pictures));
  return isAmong(models, "bump") ? addLowLightPictures(report, renderer, btf, size, models) : Result<void>{};
}

Result<std::vector<OneViewFit>> addSingleViews(HtmlReport& report, const RawBtf& btf,
                                               std::span<const ComparedModel> models) {
  const std::vector<glm::vec3>& views = btf.description().views;
  report.heading("Single views");
  report.paragraph(
      "Fits of one view each, as [Bosserhoff 2003] (2003, table 2 and figure 1), to stored values. Their "
      "views are (0°, 0°), "
      "(25°, 0°) and (50°, 0°); here are the nearest that were measured. Errors between lights are against "
      "the interpolated "
      "measurement, under four times as many, evenly spread lights; fitting those is the paper's remedy "
      "against artefacts.");
  std::vector<OneViewFit> all;
  std::vector<std::size_t> done;
  for (const double theta : {0.0, 25.0, 50.0}) {
    const std::size_t view = nearestDirection(views, directionFromDegrees(theta, 0.0));
    if (std::ranges::find(done, view) != done.end()) continue;
    done.push_back(view);
    WEFT_TRY(const std::vector<OneViewFit> fits,
             addSingleView(report, btf, views[view], isAmong(models, "laf")));
    all.insert(all.end(), fits.begin(), fits.end());
  }
  ReportTable table{
      "Average eps of luminance, time and memory of one view.",
      {"view and fit", "stored", "linear", "between lights: stored", "linear", "fit, s", "GPU, MB"},
      {}};
  for (const OneViewFit& fit : all) {
    const glm::dvec2 angles = degreesFromDirection(fit.view);
    table.rows.push_back({fmt::format("({:.0f}°, {:.0f}°): {}", angles.x, angles.y, fit.label),
                          eps(fit.errors, ErrorSpace::Stored), eps(fit.errors, ErrorSpace::Linear),
                          eps(fit.errorsBetween, ErrorSpace::Stored),
                          eps(fit.errorsBetween, ErrorSpace::Linear), fmt::format("{:.3f}", fit.seconds),
                          fmt::format("{:.3f}", static_cast<double>(fit.gpuBytes) / 1e6)});
  }
  report.table(table);
  addPapersSingleView(report);
  return all;
}

}  // namespace weft
