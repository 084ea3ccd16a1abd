#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "MeasurementInput.h"
#include "ModelArguments.h"
#include "weft/core/AtomicFile.h"
#include "weft/measurement/BtfSource.h"
#include "weft/report/Comparison.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::vector<std::string> models{"laf", "slaf", "rfp", "rfnl", "bump"};
  std::vector<int> crop;
  std::string space = "linear";
  double memoryGibibytes = 4.0;
  BtfOptions measurement;
  FitOptions fit;
  ModelArguments modelOptions{fit.models};
};

void addOptions(CLI::App& app, Arguments& a) {
  app.add_option("INPUT", a.input, kMeasurementHelp)->required();
  addMeasurementOptions(app, a.measurement);
  app.add_option("-o", a.output, "the folder for index.html, compare.json and the fits")->required();
  app.add_option("--models", a.models,
                 a.modelOptions.helpOfNames("what to compare, separated by commas; as the papers have them:"))
      ->delimiter(',')
      ->check(CLI::IsMember(a.fit.models.names()))
      ->capture_default_str();
  a.modelOptions.addTo(app);
  app.add_option("--space", a.space,
                 "linear: minimise errors of linear values, weighted as a display shows them; stored: plain "
                 "errors of the stored values, as the papers do")
      ->check(CLI::IsMember({"linear", "stored"}))
      ->capture_default_str();
  app.add_option("--crop", a.crop, "compare on these texels alone: X Y W H, from the top left")->expected(4);
  app.add_option("--memory", a.memoryGibibytes,
                 "GiB for samples: the whole measurement, and what is fitted at once")
      ->check(CLI::Range(0.0625, 1024.0))
      ->capture_default_str();
  app.add_option("--hold-out", a.fit.holdOutLights,
                 "leave about every Nth light out, and report errors on it")
      ->check(CLI::Range(2, 1000));
  app.add_option("--hold-out-views", a.fit.holdOutViews, "leave about every Nth view out, likewise")
      ->check(CLI::Range(2, 1000));
}

Result<ExitCode> compare(const Tool& tool, const Arguments& arguments) {
  const std::filesystem::path& folder = arguments.output;
  Result<std::vector<ModelDescription>> models =
      comparedModels(arguments.models, arguments.modelOptions.given(), arguments.fit.models);
  if (!models) return tool.badUsage(models.error().message());
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(arguments.input, arguments.measurement));
  tellWarnings(tool, arguments.input, source->description());
  std::optional<Crop> crop;
  if (arguments.crop.size() == 4)
    crop = Crop{arguments.crop[0], arguments.crop[1], arguments.crop[2], arguments.crop[3]};
  const auto memory = static_cast<std::size_t>(arguments.memoryGibibytes * 1024.0 * 1024.0 * 1024.0);
  WEFT_TRY(const Crop texels, checkedCrop(crop, source->description()));
  const std::size_t wholeBytes = source->description().rowBytes() * static_cast<std::size_t>(texels.height);
  if (wholeBytes > memory / 4 * 3)
    return fail(
        fmt::format("the measurement has {} bytes, more than three quarters of the memory", wholeBytes),
        arguments.input.string(), "allow more (--memory), or compare a part (--crop)");
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (error)
    return fail("the folder cannot be made: " + error.message(), folder.string(),
                "make the folder it is in first");
  for (const char* name : {"index.html", "compare.json"}) WEFT_TRY_VOID(tool.checkOutput(folder / name));

  WEFT_TRY(const RawBtf btf, RawBtf::read(*source, crop));
  ComparisonOptions options{std::move(*models), arguments.fit};
  options.fit.space = arguments.space == "stored" ? FitSpace::Stored : FitSpace::Linear;
  options.fit.cosineInModel = options.fit.space == FitSpace::Stored;
  options.fit.memory = memory - wholeBytes;
  const double texelCount = static_cast<double>(btf.description().texels());
  WEFT_TRY(const std::string text, compareModels(btf, options, folder, [&](const std::string& step) {
             return tool.progress(step, texelCount, "texels");
           }));
  Json report = Json::parse(text);
  report["peak_memory_bytes"] = peakMemoryBytes();
  report["threads"] = tool.threads();
  WEFT_TRY_VOID(writeWholeFile(folder / "compare.json", report.dump(2) + "\n"));
  WEFT_TRY_VOID(tool.writeJson(report));
  tool.print(fmt::format("{:<34} {:>8} {:>8} {:>9}\n", "eps of luminance", "stored", "linear", "fit, s"));
  for (const Json& model : report["models"])
    tool.print(fmt::format("{:<34} {:>8.4f} {:>8.4f} {:>9.2f}\n", model["label"].get<std::string>(),
                           model["epsilon"]["stored"]["luminance"]["avg"].get<double>(),
                           model["epsilon"]["linear"]["luminance"]["avg"].get<double>(),
                           model["seconds"]["fit"].get<double>()));
  tool.print((folder / "index.html").string() + "\n");
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-compare",
             "Fits several models to one measured BTF and reports how they compare, as the papers do.",
             "weft-compare UBO_WOOL64.zip --models laf,slaf,rfp,rfnl -o wool"});
  Arguments arguments;
  addOptions(tool.options(), arguments);
  return tool.run(argc, argv, [&] { return compare(tool, arguments); });
}
