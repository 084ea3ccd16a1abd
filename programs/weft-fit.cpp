#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "MeasurementInput.h"
#include "ModelArguments.h"
#include "weft/evaluation/FieldEvaluation.h"
#include "weft/fitter/DefaultModel.h"
#include "weft/fitter/FieldFit.h"
#include "weft/fitter/GlossChoice.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/report/FieldReport.h"
#include "weft/tool/ProcessGroup.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::string model;  // empty: defaultModel()
  std::string precision = "half";
  std::string cosine;
  std::string space;
  std::string gloss = "auto";
  bool resume = false;
  std::vector<int> crop;
  double memoryGibibytes = 4.0;
  double maximumError = 0.0;  // 0: no bound
  std::filesystem::path report;
  BtfOptions measurement;
  FitOptions fit;
  ModelArguments modelOptions{fit.models};
};

std::string namesOfStoredFits(const ModelRegistry& models) {
  std::vector<std::string> names;
  for (const ModelType& type : models.types())
    if (type.fitsStoredValues) names.push_back(type.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void addOptions(Tool& tool, Arguments& a) {
  CLI::App& app = tool.options();
  app.add_option("INPUT", a.input, kMeasurementHelp)->required();
  addMeasurementOptions(app, a.measurement);
  tool.addOutput("-o", a.output, "the .rf.exr to write")->required();
  app.add_option(
         "--model", a.model,
         a.modelOptions.helpOfNames("what to fit [loom; of one view what suits its number of lights]:"))
      ->check(CLI::IsMember(a.modelOptions.registry().names()));
  a.modelOptions.addTo(app);
  app.add_option("--cosine", a.cosine,
                 "out: the model is multiplied by n.l when it is shaded; in: it contains n.l as the data do "
                 "[out; in for ptm, bump and --space stored]")
      ->check(CLI::IsMember({"out", "in"}));
  app.add_option(
         "--space", a.space,
         "linear: minimise errors of linear values, weighted as a display shows them; stored: plain errors "
         "of the stored values, as the papers do [linear; stored for " +
             namesOfStoredFits(a.modelOptions.registry()) + "]")
      ->check(CLI::IsMember({"linear", "stored"}));
  app.add_option("--gloss", a.gloss,
                 "of loom: whether each texel has a lobe for what shines (loom_gloss); auto: if that lowers "
                 "errors of directions that are held out")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
  app.add_option("--float", a.precision, "precision of the parameters in the file")
      ->check(CLI::IsMember({"half", "float"}))
      ->capture_default_str();
  app.add_option("--crop", a.crop, "fit these texels alone: X Y W H, from the top left")->expected(4);
  app.add_option("--memory", a.memoryGibibytes, "GiB for the samples of the rows that are fitted at once")
      ->check(CLI::Range(0.0625, 1024.0))
      ->capture_default_str();
  app.add_option("--hold-out", a.fit.holdOutLights,
                 "leave about every Nth light out, and report errors on it")
      ->check(CLI::Range(2, 1000));
  app.add_option("--hold-out-views", a.fit.holdOutViews, "leave about every Nth view out, likewise")
      ->check(CLI::Range(2, 1000));
  app.add_flag(
      "--resume", a.resume,
      "go on with a fit that was stopped: finished rows are kept in OUTPUT.parts until the file is there");
  app.add_option("--max-error", a.maximumError,
                 "end with exit code 3 if the average eps of stored luminance is above this")
      ->check(CLI::PositiveNumber);
  tool.addOutput("--report", a.report, "write the errors, and where they are, as a page: FILE.html");
}

// The folder of finished rows.
std::filesystem::path partsOf(const std::filesystem::path& output) {
  std::filesystem::path parts = output;
  return parts += ".parts";
}

// What to fit, and why where that was not asked for.
DefaultModel modelFor(const Arguments& a, const BtfDescription& measured) {
  if (!a.model.empty()) return {a.model, ""};
  DefaultModel model = defaultModel(measured);
  const auto type = a.fit.models.find(model.name);
  const bool hasOptions =
      type && std::ranges::all_of(a.modelOptions.given(), [&](const auto& option) {
        return std::ranges::find(type->options, option.first, &ModelOption::name) != type->options.end();
      });
  return hasOptions ? model : DefaultModel{a.fit.model.name, "the options given"};
}

FitOptions fitOptions(const Tool& tool, const Arguments& a, const ModelType& type,
                      const ProcessGroup& group) {
  FitOptions options = a.fit;
  options.model.name = type.name;
  const bool asStored = type.fitsStoredValues && a.cosine != "out";
  const std::string space = !a.space.empty() ? a.space : asStored ? "stored" : "linear";
  const std::string cosine = !a.cosine.empty() ? a.cosine : space == "stored" ? "in" : "out";
  options.model.options = a.modelOptions.given();
  options.cosineInModel = cosine == "in";
  options.space = space == "stored" ? FitSpace::Stored : FitSpace::Linear;
  options.precision = a.precision == "half" ? Precision::Half : Precision::Float;
  options.memory = static_cast<std::size_t>(a.memoryGibibytes * 1024.0 * 1024.0 * 1024.0);
  if (a.crop.size() == 4) options.crop = Crop{a.crop[0], a.crop[1], a.crop[2], a.crop[3]};
  options.partsFolder = partsOf(a.output);
  // several exchange their rows this way
  options.secondsBetweenSaves = group.size() > 1 ? 0.0 : 5.0;
  options.warn = [&tool](const std::string& message) { tool.warn(message); };
  return options;
}

// Makes `loom` `loom_gloss` where that is asked for, or does better; says why where that is found
// out.
Result<std::string> takeGloss(const Arguments& a, const BtfSource& source, FitOptions& options) {
  const bool canShine = options.space == FitSpace::Linear && !options.cosineInModel;
  if (options.model.name != "loom" || a.gloss == "off" || (a.gloss == "auto" && !canShine))
    return std::string();
  if (a.gloss == "auto") {
    WEFT_TRY(const GlossChoice choice, chooseGloss(source, options.crop));
    if (choice.isTaken) options.model.name = "loom_gloss";
    return fmt::format("{}: {}\n", choice.isTaken ? "a lobe of gloss" : "no lobe of gloss", choice.reason);
  }
  options.model.name = "loom_gloss";
  return std::string();
}

// This process's share of the rows in one pass after the other; with several processes the first
// one then has those of all.
Result<void> fitRows(FieldFit& fieldFit, const Arguments& arguments, const ProcessGroup& group,
                     const Progress& progress) {
  const Result<void> claimed = group.rank() == 0 ? fieldFit.claimParts() : Result<void>();
  if (claimed && !arguments.resume && group.rank() == 0) fieldFit.removeParts();
  if (!group.allSucceeded(claimed.has_value()))  // before others write theirs
    return claimed ? fail("another process of the fit has failed") : claimed;
  const auto share = [&](int rank) { return fieldFit.height() * rank / group.size(); };
  Result<void> own = arguments.resume ? fieldFit.resume() : Result<void>();
  for (;;) {
    const int first = share(group.rank());
    if (own)
      own =
          fieldFit.fitRows(first, share(group.rank() + 1) - first, group.rank() == 0 ? progress : Progress());
    if (!group.allSucceeded(own.has_value()) && own) return fail("another process of the fit has failed");
    if (!own || fieldFit.inLastPass()) break;
    own = fieldFit.nextPass();
  }
  if (!own || group.size() == 1 || group.rank() > 0) return own;
  return fieldFit.resume();
}

Result<ExitCode> fit(const Tool& tool, const Arguments& arguments, const ProcessGroup& group) {
  if (!arguments.output.string().ends_with(".rf.exr"))
    return tool.badUsage("the output must end in .rf.exr: " + arguments.output.string());
  if (arguments.space == "stored" && arguments.cosine == "out")
    return tool.badUsage("--space stored fits the data as they are: it needs --cosine in");
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(arguments.input, arguments.measurement));
  const BtfDescription& measured = source->description();
  const DefaultModel chosen = modelFor(arguments, measured);
  WEFT_TRY(const ModelType type, arguments.fit.models.find(chosen.name));
  FitOptions options = fitOptions(tool, arguments, type, group);
  if (arguments.gloss != "auto" && type.name != "loom")
    return tool.badUsage("--gloss is for the model loom, not for " + type.name);
  const auto model = options.models.create(options.model);
  if (!model) return tool.badUsage(model.error().message());
  if (arguments.cosine == "out" && (*model)->containsCosine())
    return tool.badUsage(options.model.name + " contains n.l by its formula: it needs --cosine in");
  WEFT_TRY(const std::string gloss, takeGloss(arguments, *source, options));
  if (group.rank() == 0) tellWarnings(tool, arguments.input, measured);
  const std::size_t texels = options.crop ? static_cast<std::size_t>(options.crop->width) *
                                                static_cast<std::size_t>(options.crop->height)
                                          : measured.texels();
  WEFT_TRY(FieldFit fieldFit, FieldFit::create(*source, options));
  WEFT_TRY_VOID(
      fitRows(fieldFit, arguments, group, tool.progress("fitting", static_cast<double>(texels), "texels")));
  if (group.rank() > 0) return ExitCode::Done;
  WEFT_TRY(const FitResult result, fieldFit.finish());
  const auto startOfWriting = std::chrono::steady_clock::now();
  WEFT_TRY_VOID(writeReflectanceField(result.field, arguments.output));
  fieldFit.removeParts();
  const double secondsWriting =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - startOfWriting).count();

  Json report = Json::parse(toJson(result.errors, result.heldOut));
  addModel(report, "model", result.field.model().description());
  report["cosine"] = result.field.description().hasCosine ? "in" : "out";
  report["space"] = options.space == FitSpace::Linear ? "linear" : "stored";
  report["views"] = measured.views.size();
  report["lights"] = measured.lights.size();
  report["bytes"] = {{"file", fileBytes(arguments.output)}, {"gpu", gpuBytes(result.field)}};
  report["seconds"] = {
      {"read", result.secondsReading}, {"fit", result.secondsFitting}, {"write", secondsWriting}};
  report["peak_memory_bytes"] = peakMemoryBytes();
  report["threads"] = tool.threads();
  WEFT_TRY_VOID(tool.writeJson(report));
  if (!arguments.report.empty())
    WEFT_TRY_VOID(
        writeFieldReport(result.field, {result.errors, result.heldOut, result.texels, {}}, arguments.report));

  if (!chosen.reason.empty())
    tool.print(fmt::format("model {}, because of {} (--model takes another)\n", chosen.name, chosen.reason));
  tool.print(gloss);
  tool.print(fmt::format("{}: {} x {} texels, {} views x {} lights\n", arguments.output.string(),
                         result.field.width(), result.field.height(), measured.views.size(),
                         measured.lights.size()));
  tool.print(toText("eps (Meseth eq. 2)", result.errors));
  if (result.heldOut) tool.print(toText("of held-out pairs", *result.heldOut));
  const double error = result.errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance).average;
  return arguments.maximumError > 0.0 && error > arguments.maximumError ? ExitCode::BoundMissed
                                                                        : ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-fit", "Fits a reflectance model to every texel of a measured BTF.",
             "weft-fit UBO_WOOL64.zip -o wool.rf.exr --model rfnl --lobes 2"});
  Arguments arguments;
  addOptions(tool, arguments);
  const ProcessGroup group;
  return tool.run(argc, argv, [&] { return fit(tool, arguments, group); });
}
