#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "MeasurementInput.h"
#include "weft/core/Direction.h"
#include "weft/core/FileKind.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/report/SynthesisReport.h"
#include "weft/synthesis/SamplePicture.h"
#include "weft/synthesis/Synthesis.h"
#include "weft/synthesis/SynthesisQuality.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::filesystem::path input;
  std::filesystem::path output;
  std::vector<int> size;
  BtfOptions measurement;
  double memoryGibibytes = 4.0;
  SynthesisOptions synthesis;
  std::filesystem::path preview;
  std::filesystem::path report;

  std::size_t memory() const { return static_cast<std::size_t>(memoryGibibytes * 1024.0 * 1024.0 * 1024.0); }
};

constexpr std::array kMethods{SynthesisMethod::Patches, SynthesisMethod::KCoherence,
                              SynthesisMethod::JumpMap};

void addMethodOptions(CLI::App& app, SynthesisOptions& synthesis) {
  std::vector<std::string> names;
  for (const SynthesisMethod method : kMethods) names.emplace_back(name(method));
  app.add_option_function<std::string>(
         "--method",
         [&synthesis](const std::string& word) {
           synthesis.method = *std::ranges::find(kMethods, word, [](auto method) { return name(method); });
         },
         "patches: cut where they agree; k-coherence: texel by texel, the best of some; jump-map: texel "
         "by texel at random, for comparison [patches]")
      ->check(CLI::IsMember(names));
  app.add_option("-k", synthesis.k, "k-coherence: candidates of each neighbour")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  app.add_option("--neighborhood", synthesis.neighborhood, "not of patches: texels on each side")
      ->check(CLI::Range(1, 3))
      ->capture_default_str();
  app.add_option("--layers", synthesis.layers, "k-coherence: of the pyramid")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  app.add_option("--textons", synthesis.textons, "not of patches: clusters of texels")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  app.add_option("--seed", synthesis.seed, "another number gives another surface")->capture_default_str();
}

void addOptions(Tool& tool, Arguments& a) {
  CLI::App& app = tool.options();
  app.add_option("INPUT", a.input,
                 fmt::format("a .rf.exr (best of loom, whose texels are registered), or a measurement: {}",
                             kMeasurementHelp))
      ->required();
  addMeasurementOptions(app, a.measurement);
  tool.addOutput("-o", a.output, "the coordinate map to write: NAME.coords.exr")->required();
  app.add_option("--size", a.size, "texels of the surface: W H")
      ->required()
      ->expected(2)
      ->check(CLI::Range(8, CoordinateMap::kLargestSide));
  addMethodOptions(app, a.synthesis);
  app.add_option("--memory", a.memoryGibibytes, "GiB for the samples of a measurement that are read at once")
      ->check(CLI::Range(0.0625, 1024.0))
      ->capture_default_str();
  tool.addOutput("--preview", a.preview, "write the surface from the top as a picture: FILE.png");
  tool.addOutput("--report", a.report,
                 "write sample, tiled sample and result side by side, with their seams: FILE.html");
}

/// A fitted field or a measurement.
struct Input {
  std::optional<ReflectanceField> field;
  std::unique_ptr<BtfSource> source;
};

Result<Input> openInput(const Tool& tool, const Arguments& a) {
  Input input;
  if (a.input.extension() == ".exr" || fileKind(a.input) == FileKind::Exr) {
    WEFT_TRY(input.field, readReflectanceField(a.input));
  } else {
    WEFT_TRY(input.source, openBtf(a.input, a.measurement));
    tellWarnings(tool, a.input, input.source->description());
  }
  return input;
}

Result<AppearanceSample> appearance(const Tool& tool, const Input& input, const Arguments& a) {
  if (input.field) return appearanceOf(*input.field);
  return appearanceOf(*input.source, a.memory(), tool.progress("reading"));
}

Result<std::vector<FloatImage>> pictures(const Input& input, const Arguments& a,
                                         const std::vector<PictureDirections>& directions) {
  if (!input.field) return samplePictures(*input.source, directions, a.memory());
  std::vector<FloatImage> result;
  for (const PictureDirections& d : directions) result.push_back(samplePicture(*input.field, d));
  return result;
}

Result<void> writePictures(const Input& input, const Arguments& a, const AppearanceSample& sample,
                           const CoordinateMap& map) {
  if (a.preview.empty() && a.report.empty()) return {};
  std::vector<PictureDirections> directions;
  std::vector<std::string> captions;
  for (const int polar : {0, 45, 75}) {
    directions.push_back({directionFromDegrees(polar, 0), directionFromDegrees(45, 120)});
    captions.push_back(fmt::format("View ({}, 0), light (45, 120)", polar));
  }
  if (a.report.empty()) directions.resize(1);
  WEFT_TRY(const std::vector<FloatImage> taken, pictures(input, a, directions));
  if (!a.preview.empty()) WEFT_TRY_VOID(writePng(a.preview, mappedPicture(taken.front(), map)));
  if (!a.report.empty()) WEFT_TRY_VOID(writeSynthesisReport(sample, map, taken, captions, a.report));
  return {};
}

Json toJson(const Tool& tool, const Arguments& a, const AppearanceSample& sample, const Synthesis& made) {
  const SeamVisibility seams = seamVisibility(sample, made.map);
  return {{"method", name(a.synthesis.method)},
          {"seed", a.synthesis.seed},
          {"width", made.map.width()},
          {"height", made.map.height()},
          {"sample",
           {{"name", sample.name},
            {"width", sample.vectors.width},
            {"height", sample.vectors.height},
            {"margin", sample.margin},
            {"repeats", sample.repeats}}},
          {"appearance", {{"dimensions", sample.vectors.dimensions}, {"kept_variance", sample.keptVariance}}},
          {"seams", {{"jumps", seams.jumps}, {"visibility", seams.mean}}},
          {"bytes", {{"file", fileBytes(a.output)}}},
          {"seconds", {{"analysis", made.analysisSeconds}, {"synthesis", made.synthesisSeconds}}},
          {"peak_memory_bytes", peakMemoryBytes()},
          {"threads", tool.threads()},
          {"warnings", made.warnings}};
}

Result<ExitCode> synthesizeMap(const Tool& tool, Arguments& a) {
  a.synthesis.width = a.size[0];
  a.synthesis.height = a.size[1];
  WEFT_TRY(const Input input, openInput(tool, a));
  WEFT_TRY(const AppearanceSample sample, appearance(tool, input, a));
  WEFT_TRY(const Synthesis made, synthesize(sample, a.synthesis, tool.progress("synthesis")));
  for (const std::string& warning : made.warnings) tool.warn(a.input.string() + ": " + warning);
  WEFT_TRY_VOID(writeCoordinateMap(a.output, made.map));
  WEFT_TRY_VOID(writePictures(input, a, sample, made.map));
  WEFT_TRY_VOID(tool.writeJson(toJson(tool, a, sample, made)));
  tool.print(fmt::format("{}: {} x {} texels of {} x {}, analysis {:.2f} s, synthesis {:.2f} s\n",
                         a.output.string(), made.map.width(), made.map.height(), made.map.sampleWidth(),
                         made.map.sampleHeight(), made.analysisSeconds, made.synthesisSeconds));
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-synth", "Makes a large surface of a small sample: a map of which texel goes where.",
             "weft-synth wool.rf.exr -o wool.coords.exr --size 512 512 --preview wool.png"});
  Arguments arguments;
  addOptions(tool, arguments);
  return tool.run(argc, argv, [&] { return synthesizeMap(tool, arguments); });
}
