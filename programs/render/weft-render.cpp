// Renders a glTF scene or one of the built-in shapes, without a window, to a picture.

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "PictureArguments.h"
#include "PictureLayers.h"
#include "SceneArguments.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"
#include "weft/scene_io/SceneSetup.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/tool/ShaderCache.h"
#include "weft/tool/ThreadCheck.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;

constexpr unsigned kMostMesaThreads = 16;  // that draw, beside one or two with other work
// Linear; 0x28 of 255 in sRGB.
const glm::vec4 kPictureBackground{0.0212f, 0.0212f, 0.0212f, 1.0f};

struct Arguments {
  SceneArguments scene;
  std::filesystem::path output;
  PictureArguments picture;
  std::string show = "all";
  std::vector<std::string> layers;  ///< beside the light
  int samples = 4;                  ///< a pixel: a square number
  bool allCameras = false;
  int turntable = 0;
  int frames = 0;
};

/// The scene, or what is wrong with the command line.
tl::expected<SceneOptions, std::string> readOptions(Arguments& arguments, PictureArguments::Size& size) {
  const auto read = arguments.picture.parse(arguments.scene.scene);
  if (!read) return tl::unexpected(read.error());
  if (arguments.output.extension() != ".png" && arguments.output.extension() != ".exr")
    return tl::unexpected<std::string>("--output must end with .png or .exr");
  arguments.allCameras = arguments.scene.camera == "all";
  if (arguments.allCameras && arguments.turntable > 0)
    return tl::unexpected<std::string>(
        "--camera all and --turntable each make several pictures: one of them");
  if (arguments.allCameras) arguments.scene.camera.clear();
  if (!arguments.layers.empty() && arguments.output.extension() != ".exr")
    return tl::unexpected<std::string>("--aov needs an --output that ends with .exr");
  auto options = arguments.scene.parse();
  if (!options) return options;
  size = *read;
  options->aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  options->turns = arguments.turntable > 0;
  return options;
}

/// Milliseconds of whole frames, in their order; each ends when GL has finished it.
Result<std::vector<double>> timeFrames(int count, RenderAction& renderer, GLContext& context,
                                       const Node& root, const Camera& camera, const RenderTarget& target,
                                       const RenderOptions& options) {
  std::vector<double> times;
  for (int frame = 0; frame < count; ++frame) {
    const auto start = std::chrono::steady_clock::now();
    WEFT_TRY_VOID(renderer.render(context, root, camera, target, options));
    glFinish();
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return times;
}

/// One picture that is written.
struct Shot {
  std::filesystem::path file;
  Camera camera;
  double turn = 0.0;  ///< of the scene, radians
};

/// "cloth.png" as "cloth-front.png".
std::filesystem::path withSuffix(const std::filesystem::path& path, const std::string& suffix) {
  return path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), suffix, path.extension().string());
}

/// A name as a part of a file's: without what shells and file systems take for something else.
std::string asFileName(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 128 && !std::isalnum(static_cast<unsigned char>(c)) && c != '-')
      c = '_';
  return name.empty() ? "camera" : name;
}

/// One for each camera of the file, in its order, by their names.
std::vector<Shot> shotsOfAllCameras(const std::filesystem::path& output, const GltfScene& scene) {
  std::vector<Shot> shots;
  std::set<std::string> taken;
  for (const GltfScene::NamedCamera& named : scene.cameras) {
    const std::string name = asFileName(named.name);
    std::string own = name;
    for (int use = 2; !taken.insert(own).second; ++use) own = fmt::format("{}-{}", name, use);
    shots.push_back({withSuffix(output, own), named.camera});
  }
  return shots;
}

/// What is drawn, in its order.
Result<std::vector<Shot>> shotsOf(const Arguments& arguments, const SceneSetup& setup) {
  if (arguments.allCameras) {
    if (setup.scene().cameras.empty()) return fail("there is no camera", arguments.scene.scene);
    return shotsOfAllCameras(arguments.output, setup.scene());
  }
  if (arguments.turntable == 0) return std::vector<Shot>{{arguments.output, setup.camera()}};
  std::vector<Shot> shots;
  for (int i = 0; i < arguments.turntable; ++i)
    shots.push_back({withSuffix(arguments.output, fmt::format("{:03}", i)), setup.camera(),
                     glm::two_pi<double>() * i / arguments.turntable});
  return shots;
}

Result<void> writePicture(const std::filesystem::path& path, const FloatImage& picture) {
  if (path.extension() == ".png") return writePng(path, picture);
  return writeExr(path, picture);
}

nlohmann::ordered_json timesAsJson(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return {{"median", times[times.size() / 2]}, {"min", times.front()}, {"max", times.back()}};
}

ReflectedPart partOf(const std::string& show) {
  if (show == "diffuse") return ReflectedPart::Diffuse;
  return show == "specular" ? ReflectedPart::Specular : ReflectedPart::All;
}

/// Whether a picture shows its background alone.
bool isEmpty(const FloatImage& picture, const glm::vec4& background) {
  const auto values = picture.values();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(std::abs(values[i] - background[static_cast<int>(i % 4)]) < 1e-3f)) return false;
  return true;
}

/// Why nothing of the scene is to be seen; empty where something is.
std::string emptiness(const RenderStatistics& statistics, const FloatImage& picture,
                      const RenderOptions& options) {
  if (statistics.culled == statistics.objects)
    return "nothing of the scene is in the picture: the camera looks elsewhere, or its planes leave it out";
  if (isEmpty(picture, options.background))
    return "the picture is empty: what is in it is too small to be seen, or is seen from behind";
  return {};
}

Result<ExitCode> render(const Tool& tool, Arguments arguments) {
  PictureArguments::Size size;
  const auto sceneOptions = readOptions(arguments, size);
  if (!sceneOptions) return tool.badUsage(sceneOptions.error());
  WEFT_TRY(SceneSetup setup, SceneSetup::create(*sceneOptions));
  WEFT_TRY_VOID(tool.protect(setup.scene().files));
  WEFT_TRY(const std::vector<Shot> shots, shotsOf(arguments, setup));
  for (const Shot& shot : shots) WEFT_TRY_VOID(tool.checkOutput(shot.file));
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& warning) {
    tool.warn(warning);
    warnings.push_back(warning);
  };
  for (const std::string& warning : setup.warnings()) warn(warning);

  WEFT_TRY_VOID(checkThreads(std::min(std::thread::hardware_concurrency(), kMostMesaThreads) + 2));
  WEFT_TRY(const std::unique_ptr<HeadlessWindow> window, HeadlessWindow::create());
  GLContext& context = window->context();
  RenderAction renderer;
  const bool png = arguments.output.extension() == ".png";
  const bool lit = !sceneOptions->environment.empty();
  const int side = static_cast<int>(std::lround(std::sqrt(arguments.samples)));
  const RenderTarget target(side * size.width, side * size.height,
                            // the sun overflows halfs
                            png && !lit ? Precision::Half : Precision::Float);
  if (const auto made = target.prepare(context); !made)
    return fail(fmt::format("with {0} x {0} samples a pixel, {1}", side, made.error().what),
                fmt::format("--size {}x{}", size.width, size.height), made.error().hint);
  const RenderOptions options{png ? kPictureBackground : glm::vec4(0.0f), partOf(arguments.show)};
  for (const Shot& shot : shots) {
    setup.turn(shot.turn);
    WEFT_TRY_VOID(renderer.render(context, setup.root(), shot.camera, target, options));
    if (const std::size_t more = renderer.statistics().shadowsLeftOut; more > 0 && &shot == &shots.front())
      warn(fmt::format("{} more lights than eight are to cast shadows, and cast none", more));
    FloatImage picture = target.read(context, side);
    if (const std::string why = emptiness(renderer.statistics(), picture, options); !why.empty())
      warn(shot.file.string() + ": " + why);
    expose(picture, static_cast<float>(arguments.picture.exposure), arguments.picture.toneCurve(png && lit));
    if (!arguments.layers.empty()) {
      WEFT_TRY(picture, addLayers(picture, arguments.layers, context, renderer, setup.root(), shot.camera));
    }
    WEFT_TRY_VOID(writePicture(shot.file, picture));
  }

  nlohmann::ordered_json report{{"scene", sceneOptions->scene},
                                {"output", arguments.output.string()},
                                {"pictures", nlohmann::ordered_json::array()},
                                {"width", size.width},
                                {"height", size.height},
                                {"samples", arguments.samples},
                                {"views", arguments.scene.views},
                                {"filter", arguments.scene.filter},
                                {"tiling", arguments.scene.tiling},
                                {"materials", setup.scene().materials},
                                {"environment", sceneOptions->environment},
                                {"warnings", warnings},
                                {"gl_renderer", reinterpret_cast<const char*>(glGetString(GL_RENDERER))}};
  for (const Shot& shot : shots) report["pictures"].push_back(shot.file.string());
  if (arguments.frames > 0) {
    const RenderTarget timed(size.width, size.height);
    WEFT_TRY_VOID(
        // makes the target
        timeFrames(1, renderer, context, setup.root(), setup.camera(), timed, options));
    WEFT_TRY(std::vector<double> times,
             timeFrames(arguments.frames, renderer, context, setup.root(), setup.camera(), timed, options));
    report["frames"] = arguments.frames;
    report["frame_ms"] = timesAsJson(std::move(times));
  }
  WEFT_TRY_VOID(tool.writeJson(report));
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  avoidShaderCacheOnFullDisk();
  Tool tool({"weft-render", "Renders a glTF scene or a built-in shape with measured materials to a picture.",
             "weft-render shape:cloth --material '*=wool.rf.exr' --uv-scale 12 -o wool.png"});
  Arguments arguments;
  CLI::App& options = tool.options();
  arguments.scene.addTo(options);
  tool.addOutput("-o,--output", arguments.output, "the picture: .png (sRGB) or .exr (linear float)")
      ->required();
  arguments.picture.addTo(options);
  options
      .add_option("--samples", arguments.samples,
                  "samples a pixel, each shaded: 1, 4, 9 or 16; more make edges and far away texels smoother")
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->capture_default_str();
  options
      .add_option("--show", arguments.show,
                  "what surfaces reflect: all, or its diffuse or specular part alone (a polynomial counts as "
                  "diffuse)")
      ->check(CLI::IsMember({"all", "diffuse", "specular"}))
      ->capture_default_str();
  options
      .add_option("--aov", arguments.layers,
                  "layers of an .exr beside the light, with commas: normal (along the world's axes), depth "
                  "(along the view), albedo (the diffuse part, of light from straight above), uv; each of "
                  "the middle of a pixel")
      ->delimiter(',')
      ->check(CLI::IsMember(layerNames()));
  options
      .add_option(
          "--turntable", arguments.turntable,
          "so many pictures, NAME-000.png and on, while the scene turns once around its vertical axis; "
          "camera, --light and --env stay")
      ->check(CLI::Range(1, 1000));
  options
      .add_option("--frames", arguments.frames,
                  "time this many further frames, without supersampling, for --json")
      ->check(CLI::Range(0, 1000000));
  return tool.run(argc, argv, [&] { return render(tool, arguments); });
}
