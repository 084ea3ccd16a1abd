#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "weft/baking/BakedBtf.h"
#include "weft/baking/BtfBaker.h"
#include "weft/baking/Pattern.h"
#include "weft/baking/SurfaceMaps.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;

/// The share of values that may clip when no scale is given.
constexpr double kClippedShare = 0.001;

struct Arguments {
  std::filesystem::path output;
  std::string pattern;
  SurfaceMaps maps;
  float depth = 0.0f;  // 0: not given
  std::string directions = "ubo2003";
  int size = 64;
  float scale = 0.0f;  // 0: not given
  BakeOptions bake;
};

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void addOptions(Tool& tool, Arguments& arguments) {
  CLI::App& app = tool.options();
  std::vector<std::string> patterns(patternNames().begin(), patternNames().end());
  tool.addOutput("-o", arguments.output, "the zip to write, in UBO2003's layout")->required();
  app.add_option("--pattern", arguments.pattern, "the surface to bake")->check(CLI::IsMember(patterns));
  app.add_option("--height", arguments.maps.height,
                 "instead: a picture of its heights, which repeats; white is high");
  app.add_option("--depth", arguments.depth, "how far black lies below white, in widths of the picture")
      ->check(CLI::PositiveNumber);
  app.add_option("--albedo", arguments.maps.albedo,
                 "a picture of as many pixels: what it reflects diffusely [0.5]");
  app.add_option("--roughness", arguments.maps.roughness,
                 "likewise, as in glTF, for what a dielectric mirrors; without it the surface is matt");
  app.add_option("--size", arguments.size, "texels across")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--directions", arguments.directions, "of views and lights")
      ->check(CLI::IsMember({"ubo2003"}))
      ->capture_default_str();
  app.add_option("--samples", arguments.bake.samples, "paths a texel and view")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--bounces", arguments.bake.bounces, "interreflections")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  app.add_option("--scale", arguments.scale,
                 "factor of all values (default: at most 1, so that at most 0.1 % of them clip)")
      ->check(CLI::PositiveNumber);
}

/// Four samples of the surface a texel at the usual sizes, two at large ones: a whole number, so
/// that every texel sees as much of it.
int surfaceResolution(int size) {
  return size * std::max(2, (256 + size - 1) / size);
}

/// What is wrong with the options that say what to bake; empty: nothing.
std::string wrongSurface(const Arguments& arguments) {
  const bool isPattern = !arguments.pattern.empty(), isMap = !arguments.maps.height.empty();
  if (isPattern == isMap) return "one of --pattern and --height says what to bake";
  if (isMap && arguments.depth == 0.0f) return "--height needs a --depth";
  const bool hasMore =
      arguments.depth > 0.0f || !arguments.maps.albedo.empty() || !arguments.maps.roughness.empty();
  return isPattern && hasMore ? "--depth, --albedo and --roughness belong to a --height" : "";
}

Result<HeightField> surfaceOf(const Tool& tool, const Arguments& arguments) {
  if (!arguments.pattern.empty()) return makePattern(arguments.pattern, surfaceResolution(arguments.size));
  SurfaceMaps maps = arguments.maps;
  maps.depth = arguments.depth;
  std::vector<std::string> warnings;
  WEFT_TRY(HeightField field, readSurfaceMaps(maps, warnings));
  for (const std::string& warning : warnings) tool.warn(warning);
  return field;
}

Result<ExitCode> bake(const Tool& tool, const Arguments& arguments) {
  const std::filesystem::path& output = arguments.output;
  if (output.extension() != ".zip") return tool.badUsage("the output must be a .zip: " + output.string());
  if (const std::string wrong = wrongSurface(arguments); !wrong.empty()) return tool.badUsage(wrong);
  const Stopwatch building;
  WEFT_TRY(HeightField field, surfaceOf(tool, arguments));
  BakeOptions options = arguments.bake;
  options.width = arguments.size;
  options.height = std::max(1, (arguments.size * field.rows + field.columns / 2) / field.columns);
  WEFT_TRY(const BtfBaker baker, BtfBaker::create(std::move(field), options));
  const double buildSeconds = building.seconds();

  const Stopwatch baking;
  const double texels = static_cast<double>(options.width) * options.height;
  const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
  WEFT_TRY(
      BakedBtf baked,
      BakedBtf::bake(baker, folder,
                     tool.progress("baking", texels * static_cast<double>(options.views.size()), "texels")));
  const double bakeSeconds = baking.seconds();

  const Stopwatch writing;
  const std::string name = arguments.pattern.empty() ? output.stem().string() : arguments.pattern;
  const float scale = arguments.scale > 0.0f ? arguments.scale : baked.scaleFor(kClippedShare);
  const double clippedShare = baked.clippedShare(scale);
  WEFT_TRY_VOID(baked.writeZip(output, name, scale,
                               tool.progress("writing", static_cast<double>(options.views.size()), "views")));
  const double writeSeconds = writing.seconds();

  WEFT_TRY_VOID(tool.writeJson({
      {"pattern", name},
      {"texels", options.width * options.height},
      {"views", options.views.size()},
      {"lights", options.lights.size()},
      {"samples", options.samples},
      {"bounces", options.bounces},
      {"scale", scale},
      {"clipped_share", clippedShare},
      {"bytes", {{"file", fileBytes(output)}}},
      {"seconds", {{"build", buildSeconds}, {"bake", bakeSeconds}, {"write", writeSeconds}}},
      {"peak_memory_bytes", peakMemoryBytes()},
      {"threads", tool.threads()},
  }));
  tool.print(
      fmt::format("{}: {} x {} texels, {} views x {} lights, scale {:.4g}, {:.3g} % of values clipped\n",
                  output.string(), options.width, options.height, options.views.size(), options.lights.size(),
                  scale, 100.0 * clippedShare));
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-bake", "Ray-traces a bidirectional texture function from small-scale geometry.",
             "weft-bake -o corduroy.zip --pattern corduroy --size 64"});
  Arguments arguments;
  addOptions(tool, arguments);
  return tool.run(argc, argv, [&] { return bake(tool, arguments); });
}
