// Shows measured materials and glTF scenes in a window.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "PictureArguments.h"
#include "SceneArguments.h"
#include "Viewer.h"
#include "weft/tool/ShaderCache.h"
#include "weft/tool/ThreadCheck.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;
using Clock = std::chrono::steady_clock;

constexpr unsigned kMostMesaThreads = 16;  // that draw, beside one or two with other work

struct Arguments {
  SceneArguments scene;
  PictureArguments picture;
  std::string shape;
  std::string model;
  BtfOptions measurement;
  int frames = 0;
};

/// What to show at first, or what is wrong with the command line.
tl::expected<ViewRequest, std::string> requestFrom(const Arguments& arguments, const CLI::App& app) {
  SceneArguments words = arguments.scene;
  if (words.scene.empty()) words.scene = "shape:plane";  // to be able to read the others
  auto scene = words.parse();
  if (!scene) return tl::unexpected(scene.error());
  ViewRequest request{.file = arguments.scene.scene, .scene = std::move(*scene)};
  request.shape = arguments.shape;
  request.model = arguments.model;
  request.measurement = arguments.measurement;
  if (app.count("--uv-scale") > 0) request.uvScale = arguments.scene.uvScale;
  return request;
}

nlohmann::ordered_json reportOf(const ViewRequest& request, PictureArguments::Size size,
                                Viewer::Timing timing) {
  std::ranges::sort(timing.frames);
  return {{"scene", request.file.string()},
          {"width", size.width},
          {"height", size.height},
          {"first_frame_ms", timing.firstFrame},
          {"frames", timing.frames.size()},
          {"frame_ms",
           {{"median", timing.frames[timing.frames.size() / 2]},
            {"min", timing.frames.front()},
            {"max", timing.frames.back()}}},
          {"full_picture_ms", timing.fullPicture}};
}

Result<ExitCode> view(const Tool& tool, const CLI::App& app, Arguments arguments, Clock::time_point start) {
  const auto size = arguments.picture.parse(arguments.scene.scene);
  if (!size) return tool.badUsage(size.error());
  const auto request = requestFrom(arguments, app);
  if (!request) return tool.badUsage(request.error());
  if (arguments.frames > 0 && request->file.empty()) return tool.badUsage("--frames needs a SCENE");
  std::optional<ToneCurve> curve;
  if (!arguments.picture.toneMap.empty()) curve = arguments.picture.toneCurve(false);

  WEFT_TRY_VOID(checkThreads(std::min(std::thread::hardware_concurrency(), kMostMesaThreads) + 2));
  WEFT_TRY(const auto window, ViewerWindow::create(size->width, size->height, "weft-view"));
  ViewerState state(*request, static_cast<float>(arguments.picture.exposure), curve);
  WEFT_TRY(const auto viewer, Viewer::create(*window, state));
  if (arguments.frames == 0) {
    viewer->run();
    return ExitCode::Done;
  }
  WEFT_TRY(Viewer::Timing timing, viewer->timeDrag(arguments.frames, start));
  const auto report = reportOf(*request, *size, std::move(timing));
  tool.print(report.dump(2) + "\n");
  WEFT_TRY_VOID(tool.writeJson(report));
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  const Clock::time_point start = Clock::now();
  avoidShaderCacheOnFullDisk();
  Tool tool({"weft-view",
             "Shows a glTF scene, a reflectance field or a measurement, which it fits, in a window.",
             "weft-view wool.rf.exr"});
  Arguments arguments;
  CLI::App& options = tool.options();
  arguments.scene.addTo(options);
  options.get_option("SCENE")->description(
      "a .gltf or .glb file, a .rf.exr, a measurement, shape:plane, shape:sphere or shape:cloth; "
      "others can be dropped on the window");
  options.get_option("--uv-scale")
      ->default_str("")
      ->description(
          "repetitions of a reflectance field, or of its map's surface, per unit of texture coordinates; "
          "default: 1, of a material alone as suits it");
  arguments.picture.addTo(options);
  options
      .add_option(
          "--shape", arguments.shape,
          "what a material alone lies on: cloth, sphere or plane; default: cloth, for one view, plane")
      ->check(CLI::IsMember({"cloth", "sphere", "plane"}));
  options.add_option("--model", arguments.model, "what a measurement is fitted with; default: as weft-fit")
      ->check(CLI::IsMember(ModelRegistry::builtin().names()));
  options.add_flag("--in-order", arguments.measurement.imagesInOrder,
                   "give the lights of a light list its images in the order of their names");
  options
      .add_option("--frames", arguments.frames,
                  "drag the light around for this many frames, say what they took, and end")
      ->check(CLI::Range(0, 100000));
  return tool.run(argc, argv, [&] { return view(tool, options, arguments, start); });
}
