// Renders a glTF scene or one of the built-in shapes, without a window, to a picture.

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "weft/core/ToneMapping.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"
#include "weft/materials/ImageBasedLight.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"
#include "weft/tool/Tool.h"

namespace {

using namespace weft;

constexpr int kSupersampling = 2;
constexpr int kLargestSide = 8192;
constexpr float kLargestUvScale = 1e6f;  // beyond, a float cannot tell texels apart
// Of coordinates and colours: the squares of distances, times colours, stay within the range of a float.
constexpr float kLargestNumber = 1e9f;
constexpr double kLargestExposure = 60.0;
const glm::vec3 kDefaultView{0.6f, 0.5f, 1.0f};
// Linear; 0x28 of 255 in sRGB.
const glm::vec4 kPictureBackground{0.0212f, 0.0212f, 0.0212f, 1.0f};

struct Arguments {
  std::string scene;
  std::string output;
  std::vector<std::string> size{"800x600"};
  std::string camera;
  std::vector<std::string> lights;
  std::vector<std::string> materials;
  float uvScale = 1.0f;
  int views = 3;
  std::string filter = "bilinear";
  std::optional<double> time;
  std::string animation;
  std::string environment;
  double environmentRotation = 0.0;
  std::string environmentLobes = "fitted";
  double exposure = 0.0;
  std::string toneMap;
  std::string show = "all";
  int turntable = 0;
  int frames = 0;
};

/// What the words of the command line mean.
struct Settings {
  struct PointOfView {
    glm::vec3 eye;
    glm::vec3 target;
  };
  struct Lamp {
    glm::vec3 place;
    glm::vec3 color;
  };

  std::string scene;
  int width = 0;
  int height = 0;
  std::string cameraName;                // empty for none
  std::optional<PointOfView> viewpoint;  // instead of a name
  std::vector<Lamp> lamps;
  std::map<std::string, std::string> materialFiles;
  std::optional<double> time;
  std::string animation;
};

/// The number that `text` is, and nothing else; "nan" is one.
template <class Number>
std::optional<Number> parsed(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::vector<float>> numbers(const std::string& text) {
  std::vector<float> values;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) {
    const std::optional<float> value = parsed<float>(word);
    if (!value || !(std::abs(*value) <= kLargestNumber)) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<glm::vec3> vectorFrom(const std::string& text) {
  const auto values = numbers(text);
  if (!values || values->size() != 3 || text.ends_with(',')) return std::nullopt;
  return glm::vec3((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<int> sideFrom(const std::string& text) {
  const std::optional<int> side = parsed<int>(text);
  return side && *side >= 1 && *side <= kLargestSide ? side : std::nullopt;
}

/// "A:B" as its two sides; B is empty without a colon.
std::pair<std::string, std::string> splitAt(const std::string& text, char separator) {
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) return {text, {}};
  return {text.substr(0, at), text.substr(at + 1)};
}

/// "--size WxH" or "--size W H", which may have taken the SCENE behind it along.
bool readSize(Arguments& arguments, Settings& settings) {
  std::vector<std::string> words = arguments.size;
  if (const auto [width, height] = splitAt(words[0], 'x'); !height.empty()) {
    words[0] = width;
    words.insert(words.begin() + 1, height);
  }
  if (words.size() == 3 && arguments.scene.empty()) arguments.scene = words[2];
  if (words.size() < 2 || (words.size() == 3 && arguments.scene != words[2])) return false;
  const auto width = sideFrom(words[0]), height = sideFrom(words[1]);
  if (!width || !height) return false;
  settings.width = *width;
  settings.height = *height;
  return true;
}

bool readCamera(const std::string& text, Settings& settings) {
  const auto [eyeText, targetText] = splitAt(text, ':');
  const auto eye = vectorFrom(eyeText), target = vectorFrom(targetText);
  // Squared, their distance must not vanish.
  if (eye && target && glm::distance(*eye, *target) > 1e-9f)
    settings.viewpoint = {*eye, *target};
  else if (eye)
    return false;  // a place without a target is no name
  else
    settings.cameraName = text;
  return true;
}

bool readLamp(const std::string& text, Settings& settings) {
  const auto [placeText, colorText] = splitAt(text, ':');
  const auto place = vectorFrom(placeText);
  const auto color = colorText.empty() ? glm::vec3(1.0f) : vectorFrom(colorText);
  if (!place || !color || glm::any(glm::lessThan(*color, glm::vec3(0.0f)))) return false;
  settings.lamps.push_back({*place, *color});
  return true;
}

bool readMaterial(const std::string& text, Settings& settings) {
  const auto [name, file] = splitAt(text, '=');
  if (file.empty()) return false;
  settings.materialFiles[name] = file;
  return true;
}

/// The settings, or what is wrong with the command line.
tl::expected<Settings, std::string> readSettings(Arguments arguments) {
  Settings settings;
  if (!readSize(arguments, settings))
    return tl::unexpected(fmt::format("--size takes WxH or W H, 1 to {} pixels", kLargestSide));
  if (arguments.scene.empty()) return tl::unexpected<std::string>("SCENE is required");
  settings.scene = arguments.scene;
  // CLI11's ranges let "nan" pass.
  if (!(arguments.uvScale > 0.0f && arguments.uvScale <= kLargestUvScale))
    return tl::unexpected(fmt::format("--uv-scale takes a number above 0, up to {}", kLargestUvScale));
  if (!arguments.output.ends_with(".png") && !arguments.output.ends_with(".exr"))
    return tl::unexpected<std::string>("--output must end with .png or .exr");
  if (arguments.time && !std::isfinite(*arguments.time))
    return tl::unexpected<std::string>("--time takes seconds");
  if (!(std::abs(arguments.exposure) <= kLargestExposure))
    return tl::unexpected(fmt::format("--exposure takes up to {} stops", kLargestExposure));
  if (!std::isfinite(arguments.environmentRotation))
    return tl::unexpected<std::string>("--env-rotation takes degrees");
  if (!arguments.time && !arguments.animation.empty())
    return tl::unexpected<std::string>("--animation needs a --time");
  settings.time = arguments.time;
  settings.animation = arguments.animation;
  if (!readCamera(arguments.camera, settings))
    return tl::unexpected<std::string>("--camera takes a name or x,y,z:tx,ty,tz");
  for (const std::string& light : arguments.lights)
    if (!readLamp(light, settings)) return tl::unexpected<std::string>("--light takes x,y,z or x,y,z:r,g,b");
  for (const std::string& material : arguments.materials)
    if (!readMaterial(material, settings))
      return tl::unexpected<std::string>("--material takes NAME=FILE.rf.exr, or *=FILE.rf.exr for all");
  return settings;
}

Result<GltfScene> makeShape(const std::string& name, const GltfOptions& options) {
  std::shared_ptr<const Mesh> mesh;
  if (name == "plane") mesh = std::make_shared<const Mesh>(makePlane());
  if (name == "sphere") mesh = std::make_shared<const Mesh>(makeSphere());
  if (name == "cloth") mesh = std::make_shared<const Mesh>(makeDrapedCloth());
  if (!mesh)
    return fail("there is no such shape", "shape:" + name, "try shape:plane, shape:sphere or shape:cloth");
  std::shared_ptr<const Material> material;
  if (const auto found = options.replacements.find("*"); found != options.replacements.end())
    material = found->second;
  else
    material = std::make_shared<LambertMaterial>(
        LambertOptions{.baseColor = glm::vec4(1.0f), .baseColorTexture = nullptr, .doubleSided = true});
  GltfScene scene;
  scene.root = std::make_shared<Node>(std::make_shared<MaterialGroup>(material));
  scene.root->addChild(std::make_shared<Geometry>(mesh), name);
  scene.bounds = boundsOf(*scene.root);
  return scene;
}

Result<GltfScene> loadScene(const Settings& settings, BTFMaterialOptions btf) {
  constexpr std::string_view shapePrefix = "shape:";
  const bool isShape = settings.scene.starts_with(shapePrefix);
  btf.doubleSided = isShape;  // the inside of the cloth shows
  GltfOptions options;
  options.btf = btf;
  options.lights = settings.lamps.empty();
  options.time = settings.time;
  options.animation = settings.animation;
  for (const auto& [name, file] : settings.materialFiles) {
    WEFT_TRY(options.replacements[name], loadBTFMaterial(file, btf));
  }
  WEFT_TRY(GltfScene scene, isShape ? makeShape(settings.scene.substr(shapePrefix.size()), options)
                                    : loadGltf(settings.scene, options));
  for (const auto& [name, file] : settings.materialFiles)
    if (name != "*" &&
        std::find(scene.materials.begin(), scene.materials.end(), name) == scene.materials.end())
      return fail(
          "there is no material \"" + name + "\"", settings.scene,
          scene.materials.empty() ? "use *=" + file : fmt::format("its materials are {}", scene.materials));
  return scene;
}

/// A camera at a place of its own, whose clipping planes enclose the scene.
Camera cameraAt(const Settings::PointOfView& viewpoint, const Bounds& bounds) {
  const glm::vec3 direction = glm::normalize(viewpoint.target - viewpoint.eye);
  const bool vertical = std::abs(direction.y) > 0.999f;
  Camera camera =
      Camera::lookAt(viewpoint.eye, viewpoint.target, vertical ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0));
  const float distance = glm::distance(viewpoint.eye, bounds.center());
  const float radius = std::max(bounds.radius(), 1e-6f);
  camera.farPlane = distance + 1.01f * radius;
  camera.nearPlane = std::max(distance - 1.01f * radius, 1e-3f * camera.farPlane);
  return camera;
}

/// The cylinder that a scene does not leave when it turns.
std::shared_ptr<Node> cylinderAround(const Bounds& bounds) {
  const glm::vec3 half = bounds.maximum - bounds.center();
  Mesh cylinder = makeSphere(16);
  for (glm::vec3& p : cylinder.positions) {
    const glm::vec2 across(p.x, p.z);
    const glm::vec2 rim = across * (std::hypot(half.x, half.z) / std::max(glm::length(across), 1e-6f));
    p = bounds.center() + glm::vec3(rim.x, std::copysign(half.y, p.y), rim.y);
  }
  return std::make_shared<Node>(std::make_shared<Geometry>(std::make_shared<Mesh>(std::move(cylinder))));
}

Result<Camera> chooseCamera(const Settings& settings, const GltfScene& scene, bool turns) {
  if (settings.viewpoint) return cameraAt(*settings.viewpoint, scene.bounds);
  for (const GltfScene::NamedCamera& named : scene.cameras)
    if (settings.cameraName.empty() || named.name == settings.cameraName) return named.camera;
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  if (settings.cameraName.empty())
    return turns ? frame(*cylinderAround(scene.bounds), kDefaultView, aspect)
                 : frame(*scene.root, kDefaultView, aspect);
  std::vector<std::string> names;
  for (const GltfScene::NamedCamera& named : scene.cameras) names.push_back(named.name);
  return fail("there is no camera \"" + settings.cameraName + "\"", settings.scene,
              fmt::format("its cameras are {}", names));
}

/// Lamps as bright as it takes for a white surface at the scene's centre that faces them to show their
/// colour.
void addLamps(std::vector<Settings::Lamp> lamps, bool needed, const Camera& camera, const Bounds& bounds,
              Node& root) {
  const glm::vec3 center = bounds.center();
  if (lamps.empty() && needed) {
    const glm::mat3 toWorld = glm::transpose(glm::mat3(camera.view));
    lamps.push_back(
        {center + 4.0f * std::max(bounds.radius(), 1e-6f) * (toWorld * glm::vec3(-0.7f, 0.8f, 1.0f)),
         glm::vec3(1.0f)});
  }
  for (const Settings::Lamp& lamp : lamps) {
    const glm::vec3 offset = lamp.place - center;
    const glm::vec3 intensity = glm::pi<float>() * glm::dot(offset, offset) * lamp.color;
    root.addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), lamp.place)))
        ->addChild(std::make_shared<PointLight>(intensity));
  }
}

/// The light of `--env`; `warnings` gets what is odd about it.
Result<void> addEnvironment(const Arguments& arguments, Node& root, std::vector<std::string>& warnings) {
  std::vector<std::string> found;
  WEFT_TRY(const Environment environment, environmentNamed(arguments.environment, found));
  for (const std::string& warning : found) warnings.push_back(arguments.environment + ": " + warning);
  const LobeLookup lookup = arguments.environmentLobes == "paper" ? LobeLookup::Paper : LobeLookup::Fitted;
  // Clockwise as seen on a map: the picture's middle comes to lie to the right of where it was.
  const float angle = glm::radians(-static_cast<float>(std::fmod(arguments.environmentRotation, 360.0)));
  root.addChild(std::make_shared<Transform>(glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0))))
      ->addChild(makeEnvironmentLight(environment, prefilter(environment, cacheFolder()), lookup));
  return {};
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

/// Where the scene is when it has turned by an angle, counter-clockwise seen from above.
glm::mat4 turned(float radians, glm::vec3 center) {
  const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), radians, glm::vec3(0, 1, 0));
  return glm::translate(glm::mat4(1.0f), center) * turn * glm::translate(glm::mat4(1.0f), -center);
}

/// "cloth.png" as "cloth-007.png".
std::string numbered(const std::string& path, int number) {
  const std::size_t end = path.size() - 4;
  return fmt::format("{}-{:03}{}", path.substr(0, end), number, path.substr(end));
}

Result<void> writePicture(const std::string& path, const FloatImage& picture) {
  if (path.ends_with(".png")) return writePng(path, picture);
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

ToneCurve curveOf(const std::string& name, bool softUnasked) {
  return name == "soft" || (name.empty() && softUnasked) ? ToneCurve::Soft : ToneCurve::None;
}

Result<ExitCode> render(const Tool& tool, const Arguments& arguments) {
  const auto settings = readSettings(arguments);
  if (!settings) return tool.badUsage(settings.error());
  WEFT_TRY(GltfScene scene,
           loadScene(*settings,
                     {.textureScale = glm::vec2(arguments.uvScale),
                      .interpolatedViews = arguments.views,
                      .filter = arguments.filter == "nearest" ? TexelFilter::Nearest : TexelFilter::Bilinear,
                      .preparedForEnvironments =
                          !arguments.environment.empty() && arguments.environmentLobes == "fitted"}));
  std::vector<std::string> warnings;
  for (const std::string& warning : scene.warnings)
    warnings.push_back(fmt::format("{}: {}", settings->scene, warning));
  WEFT_TRY(const Camera camera, chooseCamera(*settings, scene, arguments.turntable > 0));
  Node root;  // of what stays while the scene turns, too
  const auto turn = std::make_shared<Transform>();
  root.addChild(turn)->addChild(scene.root);
  const bool lit = !arguments.environment.empty();
  if (lit) WEFT_TRY_VOID(addEnvironment(arguments, root, warnings));
  addLamps(settings->lamps, !lit && scene.lights == 0, camera, scene.bounds, root);
  if (!tool.quiet())
    for (const std::string& warning : warnings) fmt::print(stderr, "weft-render: {}\n", warning);

  WEFT_TRY(const std::unique_ptr<HeadlessWindow> window, HeadlessWindow::create());
  GLContext& context = window->context();
  RenderAction renderer;
  const bool png = arguments.output.ends_with(".png");
  const RenderTarget target(kSupersampling * settings->width, kSupersampling * settings->height,
                            png && !lit ? Precision::Half : Precision::Float);  // the sun overflows halfs
  const RenderOptions options{png ? kPictureBackground : glm::vec4(0.0f), partOf(arguments.show)};
  const int pictures = std::max(arguments.turntable, 1);
  for (int i = 0; i < pictures; ++i) {
    turn->setMatrix(turned(glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(pictures),
                           scene.bounds.center()));
    WEFT_TRY_VOID(renderer.render(context, root, camera, target, options));
    FloatImage picture = target.read(context, kSupersampling);
    expose(picture, static_cast<float>(arguments.exposure), curveOf(arguments.toneMap, png && lit));
    WEFT_TRY_VOID(
        writePicture(arguments.turntable > 0 ? numbered(arguments.output, i) : arguments.output, picture));
  }

  nlohmann::ordered_json report{{"scene", settings->scene},
                                {"output", arguments.output},
                                {"width", settings->width},
                                {"height", settings->height},
                                {"views", arguments.views},
                                {"filter", arguments.filter},
                                {"materials", scene.materials},
                                {"environment", arguments.environment},
                                {"warnings", warnings},
                                {"gl_renderer", reinterpret_cast<const char*>(glGetString(GL_RENDERER))}};
  if (arguments.frames > 0) {
    const RenderTarget timed(settings->width, settings->height);
    WEFT_TRY_VOID(timeFrames(1, renderer, context, root, camera, timed, options));  // makes the target
    WEFT_TRY(std::vector<double> times,
             timeFrames(arguments.frames, renderer, context, root, camera, timed, options));
    report["frames"] = arguments.frames;
    report["frame_ms"] = timesAsJson(std::move(times));
  }
  WEFT_TRY_VOID(tool.writeJson(report));
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"weft-render", "Renders a glTF scene or a built-in shape with measured materials to a picture.",
             "weft-render shape:cloth --material '*=wool.rf.exr' --uv-scale 12 -o wool.png", WEFT_VERSION});
  Arguments arguments;
  CLI::App& options = tool.options();
  options.add_option("SCENE", arguments.scene,
                     "a .gltf or .glb file, or shape:plane (side 1 at z = 0, facing +Z: columns of the "
                     "material's image run along +X, its rows down, along -Y), shape:sphere (radius 1, "
                     "poles on Y), shape:cloth (draped over a ball; up is +Y)");
  options.add_option("-o,--output", arguments.output, "the picture: .png (sRGB) or .exr (linear float)")
      ->required();
  options.add_option("--size", arguments.size, "WxH or W H in pixels")->expected(1, 3)->capture_default_str();
  options.add_option("--camera", arguments.camera,
                     "a camera of the file, or x,y,z:tx,ty,tz: from where to what; default: the file's "
                     "first, or all of the scene");
  options
      .add_option(
          "--light", arguments.lights,
          "x,y,z[:r,g,b]: a point light under which white at the scene's centre shows r,g,b (1,1,1); "
          "repeatable, instead of the file's lights; default without those: one above left of the camera")
      ->allow_extra_args(false);
  options
      .add_option("--material", arguments.materials,
                  "NAME=FILE.rf.exr: shows a material of the scene as this reflectance field; * for all that "
                  "are not named; repeatable")
      ->allow_extra_args(false);
  options
      .add_option("--uv-scale", arguments.uvScale,
                  "repetitions of a reflectance field per unit of texture coordinates")
      ->capture_default_str();
  options
      .add_option("--views", arguments.views, "measured views to interpolate between: 1 (the nearest) or 3")
      ->check(CLI::IsMember({1, 3}))
      ->capture_default_str();
  options
      .add_option(
          "--filter", arguments.filter,
          "what is between texels: nearest, or bilinear, which is smooth and costs four times as much")
      ->check(CLI::IsMember({"nearest", "bilinear"}))
      ->capture_default_str();
  options.add_option("--env", arguments.environment,
                     "light from all sides, and background: an equirectangular .hdr or .exr, or the built-in "
                     "studio or sky; together with lights that are asked for or the file's");
  options.add_option("--env-rotation", arguments.environmentRotation,
                     "degrees by which the environment turns around Y, clockwise seen from above; at 0 its "
                     "middle lies along -Z");
  options
      .add_option("--env-lobes", arguments.environmentLobes,
                  "how lobes gather its light: fitted, or paper, as Meseth et al. do, for comparison")
      ->check(CLI::IsMember({"fitted", "paper"}))
      ->capture_default_str();
  options
      .add_option("--exposure", arguments.exposure, "stops: the picture is multiplied by 2 to their power")
      ->capture_default_str();
  options
      .add_option("--tone-map", arguments.toneMap,
                  "none, or soft: what is brighter than 0.8 is compressed below 1; default: soft for a .png "
                  "with --env, else none")
      ->check(CLI::IsMember({"none", "soft"}));
  options
      .add_option("--show", arguments.show,
                  "what surfaces reflect: all, or its diffuse or specular part alone (a polynomial counts as "
                  "diffuse)")
      ->check(CLI::IsMember({"all", "diffuse", "specular"}))
      ->capture_default_str();
  options.add_option("--time", arguments.time,
                     "shows the scene so many seconds after the start of its animation");
  options.add_option("--animation", arguments.animation, "which animation; default: the file's first");
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
