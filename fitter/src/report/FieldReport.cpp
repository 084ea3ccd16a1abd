#include "weft/report/FieldReport.h"

#include <fmt/format.h>

#include <array>
#include <tuple>

#include "weft/core/Direction.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

std::string degrees(glm::vec3 direction) {
  const glm::dvec2 angles = degreesFromDirection(direction);
  return fmt::format("({:.0f}, {:.0f})", angles.x, angles.y);
}

Result<void> addPairs(HtmlReport& report, const std::vector<PairPictures>& pairs) {
  report.heading("Pictures");
  report.paragraph(
      "The measured texels and what the model gives for them, views and lights as (polar angle, azimuth) in "
      "degrees.");
  for (const PairPictures& pair : pairs) {
    WEFT_TRY(Image measured, displayImage(pair.measured));
    WEFT_TRY(Image model, displayImage(pair.model));
    const std::string place = fmt::format("view {}, light {}", degrees(pair.view), degrees(pair.light));
    WEFT_TRY_VOID(report.pictures(std::array{ReportPicture{std::move(measured), "Measured: " + place},
                                             ReportPicture{std::move(model), "Model: " + place}}));
  }
  return {};
}

}  // namespace

ReportTable errorTable(const FitErrors& errors, std::string caption) {
  ReportTable table{std::move(caption), {"eps", "avg", "min", "max", "95 %", "RMSE", "PSNR, dB"}, {}};
  for (const auto& [label, space, measure] :
       {std::tuple("stored luminance", ErrorSpace::Stored, ErrorMeasure::Luminance),
        std::tuple("stored RGB", ErrorSpace::Stored, ErrorMeasure::Rgb),
        std::tuple("linear luminance", ErrorSpace::Linear, ErrorMeasure::Luminance),
        std::tuple("linear RGB", ErrorSpace::Linear, ErrorMeasure::Rgb)}) {
    const ErrorStatistics& s = errors.of(space, measure);
    std::vector<std::string> row{label};
    for (const double value : {s.average, s.minimum, s.maximum, s.percentile95, s.rootMeanSquare})
      row.push_back(fmt::format("{:.4f}", value));
    row.push_back(fmt::format("{:.1f}", s.psnr));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Result<void> writeFieldReport(const ReflectanceField& field, const FieldEvaluation& evaluation,
                              const std::filesystem::path& path) {
  const ReflectanceFieldDescription& description = field.description();
  HtmlReport report(fmt::format("{}: {}", description.source, field.model().options().label()));
  report.paragraph(fmt::format("{} x {} texels, {} views, {} lights.", field.width(), field.height(),
                               description.views.size(), description.lights.size()));
  if (evaluation.warning) report.paragraph(*evaluation.warning + ".");
  report.heading("Errors");
  report.paragraph(
      "eps is the mean absolute difference over all pairs of view and light, for each texel (eq. 2 of Meseth "
      "et al. 2004); "
      "average, extremes and 95th percentile are over texels. Stored values are encoded as the measurement "
      "is, linear ones are proportional to light.");
  report.table(errorTable(evaluation.errors, "Over the pairs that were fitted."));
  report.paragraph(fmt::format("Views at 60 degrees and lower: eps of stored luminance is {:.4f}.",
                               evaluation.errors.grazing));
  if (evaluation.heldOut)
    report.table(errorTable(*evaluation.heldOut, "Over pairs whose view or light was held out of the fit."));
  const ErrorStatistics& stored = evaluation.errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance);
  const ColorScale scale{static_cast<float>(stored.minimum), static_cast<float>(stored.maximum),
                         "eps of stored luminance"};
  WEFT_TRY_VOID(report.pictures(
      std::array{ReportPicture{colorMapped(errorMap(evaluation.texels, field.width(), field.height()), scale),
                               "Where the errors are: eps of every texel.", scale}}));
  if (!evaluation.pairs.empty()) WEFT_TRY_VOID(addPairs(report, evaluation.pairs));
  return report.write(path);
}

}  // namespace weft
