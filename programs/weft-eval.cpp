#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "MeasurementInput.h"
#include "ModelArguments.h"
#include "weft/core/Direction.h"
#include "weft/evaluation/FieldEvaluation.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/report/FieldReport.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path field;
  std::filesystem::path measurement;
  BtfOptions options;
  std::vector<int> crop;
  double memoryGibibytes = 4.0;
  std::filesystem::path report;
  std::vector<double> view;
  std::vector<double> light;
  std::filesystem::path output;
};

void addOptions(Tool& tool, Arguments& a) {
  CLI::App& app = tool.options();
  app.add_option("FIELD", a.field, "a .rf.exr")->required();
  app.add_option("--against", a.measurement, fmt::format("the measurement: {}", kMeasurementHelp));
  addMeasurementOptions(app, a.options);
  app.add_option("--crop", a.crop, "the texels that were fitted: X Y W H, from the top left")->expected(4);
  app.add_option("--memory", a.memoryGibibytes, "GiB for the samples that are compared at once")
      ->check(CLI::Range(0.0625, 1024.0))
      ->capture_default_str();
  tool.addOutput("--report", a.report, "write errors, where they are, and pictures as a page: FILE.html")
      ->needs("--against");
  CLI::Option* image = app.add_option_function<std::vector<double>>(
      "--image",
      [&a](const std::vector<double>& degrees) {
        a.view = {degrees[0], degrees[1]};
        a.light = {degrees[2], degrees[3]};
      },
      "write what the field gives for one view and one light, each a polar angle and an azimuth in degrees");
  image->expected(4);
  tool.addOutput("-o", a.output, "the picture of --image to write, linear RGB, n.l included: FILE.exr")
      ->needs(image);
  image->needs("-o");
}

Result<void> writeImage(const ReflectanceField& field, const Arguments& arguments) {
  const glm::vec3 view = directionFromDegrees(arguments.view[0], arguments.view[1]);
  const glm::vec3 light = directionFromDegrees(arguments.light[0], arguments.light[1]);
  FloatImage image(field.width(), field.height(), {"R", "G", "B"});
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x) {
      const glm::vec3 value = field.evaluate(x, y, light, view);
      for (int channel = 0; channel < 3; ++channel) image.at(x, y, channel) = value[channel];
    }
  return writeExr(arguments.output, image);
}

Result<void> compare(const Tool& tool, const ReflectanceField& field, const Arguments& arguments) {
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(arguments.measurement, arguments.options));
  tellWarnings(tool, arguments.measurement, source->description());
  std::optional<Crop> crop;
  if (arguments.crop.size() == 4)
    crop = Crop{arguments.crop[0], arguments.crop[1], arguments.crop[2], arguments.crop[3]};
  const auto memory = static_cast<std::size_t>(arguments.memoryGibibytes * 1024.0 * 1024.0 * 1024.0);
  const double texels = static_cast<double>(field.width()) * field.height();
  WEFT_TRY(const FieldEvaluation evaluation,
           evaluateField(field, *source, crop, memory, tool.progress("comparing", texels, "texels")));

  if (evaluation.warning) tool.warn(*evaluation.warning);
  Json json = Json::parse(toJson(evaluation.errors, evaluation.heldOut));
  addModel(json, "model", field.model().description());
  json["views"] = source->description().views.size();
  json["lights"] = source->description().lights.size();
  json["bytes"] = {{"file", fileBytes(arguments.field)}, {"gpu", gpuBytes(field)}};
  json["warnings"] = Json::array();
  if (evaluation.warning) json["warnings"].push_back(*evaluation.warning);
  WEFT_TRY_VOID(tool.writeJson(json));
  if (!arguments.report.empty()) WEFT_TRY_VOID(writeFieldReport(field, evaluation, arguments.report));
  tool.print(fmt::format("{}: {}, {} x {} texels\n", arguments.field.string(),
                         field.model().options().label(), field.width(), field.height()));
  tool.print(toText("eps (Meseth eq. 2)", evaluation.errors));
  if (evaluation.heldOut) tool.print(toText("of held-out pairs", *evaluation.heldOut));
  return {};
}

Result<ExitCode> evaluate(const Tool& tool, const Arguments& arguments) {
  if (arguments.measurement.empty() && arguments.view.empty())
    return tool.badUsage("nothing to do: give --against or --image");
  if (!arguments.view.empty() && arguments.output.extension() != ".exr")
    return tool.badUsage("-o takes a .exr, which is what --image writes: " + arguments.output.string());
  WEFT_TRY(const ReflectanceField field, readReflectanceField(arguments.field));
  if (!arguments.view.empty()) WEFT_TRY_VOID(writeImage(field, arguments));
  if (!arguments.measurement.empty()) WEFT_TRY_VOID(compare(tool, field, arguments));
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-eval", "Says how well a reflectance field reproduces a measured BTF.",
             "weft-eval wool.rf.exr --against UBO_WOOL64.zip --report wool.html"});
  Arguments arguments;
  addOptions(tool, arguments);
  return tool.run(argc, argv, [&] { return evaluate(tool, arguments); });
}
