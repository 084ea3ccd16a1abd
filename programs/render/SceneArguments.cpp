#include "SceneArguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <sstream>

namespace weft {
namespace {

constexpr float kLargestUvScale = 1e6f;  // beyond, a float cannot tell texels apart
// Of coordinates and colours: the squares of distances, times colours, stay within the range of a
// float.
constexpr double kLargestNumber = 1e12;
constexpr double kShortestLook = 1e-15;  // as small as scenes may be

std::optional<double> parsed(const std::string& text) {
  double number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::vector<double>> numbers(const std::string& text) {
  std::vector<double> values;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) {
    const std::optional<double> value = parsed(word);
    if (!value || !(std::abs(*value) <= kLargestNumber)) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<glm::dvec3> vectorFrom(const std::string& text) {
  const auto values = numbers(text);
  if (!values || values->size() != 3 || text.ends_with(',')) return std::nullopt;
  return glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
}

/// "A:B" as its two sides; B is empty without a colon.
std::pair<std::string, std::string> splitAt(const std::string& text, char separator) {
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) return {text, {}};
  return {text.substr(0, at), text.substr(at + 1)};
}

bool readCamera(const std::string& text, SceneOptions& options) {
  const auto [eyeText, targetText] = splitAt(text, ':');
  const auto eye = vectorFrom(eyeText), target = vectorFrom(targetText);
  if (eye && target && glm::distance(*eye, *target) > kShortestLook)
    options.viewpoint = {*eye, *target};
  else if (eye)
    return false;  // a place without a target is no name
  else
    options.cameraName = text;
  return true;
}

bool readLamp(const std::string& text, SceneOptions& options) {
  if (text == "studio") return options.studio = true;
  const auto [placeText, colorText] = splitAt(text, ':');
  const auto place = vectorFrom(placeText);
  const auto color = colorText.empty() ? glm::dvec3(1.0) : vectorFrom(colorText);
  if (!place || !color || glm::any(glm::lessThan(*color, glm::dvec3(0.0)))) return false;
  options.lamps.push_back({*place, *color});
  return true;
}

/// "NAME=FILE", where both may hold a "=": at the first one behind which a file stands that is
/// there, else at the first.
bool readFile(const std::string& text, std::map<std::string, std::string>& files) {
  auto [name, file] = splitAt(text, '=');
  if (file.empty()) return false;
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(text.substr(at + 1), none)) continue;
    name = text.substr(0, at);
    file = text.substr(at + 1);
    break;
  }
  files[name] = file;
  return true;
}

}  // namespace

void SceneArguments::addTo(CLI::App& options) {
  options.add_option(
      "SCENE", scene,
      "a .gltf or .glb file, or shape:plane (longer side 1, at z = 0, facing +Z: columns of the "
      "material's image run along +X, its rows down, along -Y), shape:sphere (radius 1, "
      "poles on Y), shape:cloth (draped over a ball; up is +Y)");
  options.add_option("--camera", camera,
                     "a camera of the file, or x,y,z:tx,ty,tz: from where to what; default: the file's "
                     "first, or all of the scene; all, of weft-render: a picture of each of the file's, "
                     "OUTPUT-NAME.png, in the light of the first");
  options
      .add_option(
          "--light", lights,
          "x,y,z[:r,g,b]: a point light under which white at the scene's centre shows r,g,b (1,1,1); or "
          "studio: a key light above left of what the camera sees, a fill to its right, a rim light behind; "
          "repeatable, instead of the file's lights; default where there is no light: studio; in weft-view, "
          "one lamp, which is quicker")
      ->allow_extra_args(false);
  options
      .add_option("--material", materials,
                  "NAME=FILE.rf.exr: shows a material of the scene as this reflectance field; * for all that "
                  "are not named; repeatable")
      ->allow_extra_args(false);
  options
      .add_option("--map", maps,
                  "NAME=FILE.coords.exr: a larger surface that the texels of this --material's reflectance "
                  "field are put together to; repeatable")
      ->allow_extra_args(false);
  options
      .add_option(
          "--uv-scale", uvScale,
          "repetitions of a reflectance field, or of its map's surface, per unit of texture coordinates")
      ->capture_default_str();
  options.add_option("--views", views, "measured views to interpolate between: 1 (the nearest) or 3")
      ->check(CLI::IsMember({1, 3}))
      ->capture_default_str();
  options
      .add_option("--filter", filter,
                  "what is between texels: nearest, or bilinear, which is smooth, costs most models four "
                  "times as much, and shows the coarser levels of loom")
      ->check(CLI::IsMember({"nearest", "bilinear"}))
      ->capture_default_str();
  options
      .add_option("--tiling", tiling,
                  "how samples without a --map cover a surface: repeat, or stochastic: pieces at random, "
                  "blended; of loom alone, for four times the work")
      ->check(CLI::IsMember({"repeat", "stochastic"}))
      ->capture_default_str();
  options.add_option("--env", environment,
                     "light from all sides, and background: an equirectangular .hdr or .exr, or the built-in "
                     "studio or sky; together with lights that are asked for or the file's");
  options.add_option("--env-rotation", environmentRotation,
                     "degrees by which the environment turns around Y, clockwise seen from above; at 0 its "
                     "middle lies along -Z");
  options
      .add_option("--env-lobes", environmentLobes,
                  "how lobes gather its light: fitted, or paper, as [Meseth 2004] do, for comparison")
      ->check(CLI::IsMember({"fitted", "paper"}))
      ->capture_default_str();
  options.add_flag("--shadows", shadows,
                   "lights cast shadows, eight of them at most; an environment does not");
  options.add_option("--time", time, "shows the scene so many seconds after the start of its animation");
  options.add_option("--animation", animation, "which animation; default: the file's first");
}

tl::expected<SceneOptions, std::string> SceneArguments::parse() const {
  SceneOptions options;
  if (scene.empty()) return tl::unexpected<std::string>("SCENE is required");
  options.scene = scene;
  // CLI11's ranges let "nan" pass.
  if (!(uvScale > 0.0f && uvScale <= kLargestUvScale))
    return tl::unexpected(fmt::format("--uv-scale takes a number above 0, up to {}", kLargestUvScale));
  if (time && !std::isfinite(*time)) return tl::unexpected<std::string>("--time takes seconds");
  if (!std::isfinite(environmentRotation)) return tl::unexpected<std::string>("--env-rotation takes degrees");
  if (!time && !animation.empty()) return tl::unexpected<std::string>("--animation needs a --time");
  options.time = time;
  options.animation = animation;
  if (!readCamera(camera, options))
    return tl::unexpected(fmt::format(
        "--camera takes a name or x,y,z:tx,ty,tz, two places of numbers up to {}", kLargestNumber));
  for (const std::string& light : lights)
    if (!readLamp(light, options))
      return tl::unexpected(
          fmt::format("--light takes studio, x,y,z or x,y,z:r,g,b, numbers up to {}, colours not below 0",
                      kLargestNumber));
  for (const std::string& material : materials)
    if (!readFile(material, options.materialFiles))
      return tl::unexpected<std::string>("--material takes NAME=FILE.rf.exr, or *=FILE.rf.exr for all");
  for (const std::string& map : maps)
    if (!readFile(map, options.mapFiles))
      return tl::unexpected<std::string>("--map takes NAME=FILE.coords.exr, with a NAME of --material");
  options.environment = environment;
  options.shadows = shadows;
  options.environmentRotation = environmentRotation;
  options.environmentLobes = environmentLobes == "paper" ? LobeLookup::Paper : LobeLookup::Fitted;
  options.btf = {.textureScale = glm::vec2(uvScale),
                 .interpolatedViews = views,
                 .filter = filter == "nearest" ? TexelFilter::Nearest : TexelFilter::Bilinear,
                 .tiling = tiling == "stochastic" ? Tiling::Stochastic : Tiling::Repeat,
                 .preparedForEnvironments = !environment.empty() && environmentLobes == "fitted"};
  return options;
}

}  // namespace weft
