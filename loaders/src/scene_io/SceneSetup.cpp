#include "weft/scene_io/SceneSetup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>

#include "RepetitionCheck.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Traversal.h"

namespace weft {
namespace {

constexpr std::string_view kShapePrefix = "shape:";
const glm::vec3 kDefaultView{0.6f, 0.5f, 1.0f};
// Places as the camera sees them, to the right, up and towards it, in four radii of the scene.
const SceneOptions::Lamp kSingleLamp{{-0.7, 0.8, 1.0}, glm::vec3(1.0f)};
const std::array<SceneOptions::Lamp, 3> kStudio{{{{-0.9, 0.9, 0.7}, {1.0f, 0.96f, 0.91f}},
                                                 {{0.9, 0.0, 1.0}, {0.15f, 0.17f, 0.2f}},
                                                 {{0.7, 0.6, -1.0}, {0.3f, 0.32f, 0.35f}}}};

// A plane on which the texels of the surface are square: its longer side is 1.
Mesh planeFor(const BTFMaterial* material) {
  Mesh plane = makePlane();
  if (!material) return plane;
  const glm::vec2 texels(material->surfaceSize());
  const glm::vec3 sides(texels / std::max(texels.x, texels.y), 1.0f);
  for (glm::vec3& position : plane.positions) position *= sides;
  return plane;
}

Result<GltfScene> makeShape(const std::string& name, std::shared_ptr<const BTFMaterial> replacement) {
  std::shared_ptr<const Mesh> mesh;
  if (name == "plane") mesh = std::make_shared<const Mesh>(planeFor(replacement.get()));
  if (name == "sphere") mesh = std::make_shared<const Mesh>(makeSphere());
  if (name == "cloth") mesh = std::make_shared<const Mesh>(makeDrapedCloth());
  if (!mesh)
    return fail("there is no such shape", "shape:" + name, "try shape:plane, shape:sphere or shape:cloth");
  std::shared_ptr<const Material> material = std::move(replacement);
  if (!material)
    material = std::make_shared<LambertMaterial>(
        LambertOptions{.baseColor = glm::vec4(1.0f), .baseColorTexture = nullptr, .doubleSided = true});
  GltfScene scene;
  scene.root = std::make_shared<Node>(std::make_shared<MaterialGroup>(material));
  scene.root->addChild(std::make_shared<Geometry>(mesh), name);
  scene.bounds = boundsOf(*scene.root);
  return scene;
}

Result<void> checkMaps(const SceneOptions& options) {
  for (const auto& [name, map] : options.mapFiles)
    if (!options.materialFiles.contains(name))
      return fail(fmt::format("the coordinate map of \"{}\" has no reflectance field", name), map,
                  "name the material's field, too");
  return {};
}

// The materials that the options put on the scene.
Result<std::vector<GltfScene::FieldMaterial>> replacementsOf(const SceneOptions& options,
                                                             const BTFMaterialOptions& btf,
                                                             FieldCache& fields) {
  std::vector<GltfScene::FieldMaterial> replacements;
  for (const auto& [name, file] : options.materialFiles) {
    const auto map = options.mapFiles.find(name);
    const std::filesystem::path mapFile = map == options.mapFiles.end() ? std::string() : map->second;
    WEFT_TRY(const std::shared_ptr<BTFMaterial> material, loadBTFMaterial(file, btf, fields, mapFile));
    replacements.push_back({name, file, material});
  }
  for (const auto& [name, material] : options.materials) replacements.push_back({name, {}, material});
  return replacements;
}

Result<void> checkNames(const std::vector<GltfScene::FieldMaterial>& replacements, const GltfScene& scene,
                        const std::string& where) {
  for (const auto& [name, file, material] : replacements)
    if (name != "*" && std::ranges::find(scene.materials, name) == scene.materials.end())
      return fail("there is no material \"" + name + "\"", where,
                  scene.materials.empty() ? "use *=" + file.string()
                                          : fmt::format("its materials are {}", scene.materials));
  return {};
}

Result<GltfScene> loadScene(const SceneOptions& options) {
  const bool isShape = options.scene.starts_with(kShapePrefix);
  BTFMaterialOptions btf = options.btf;
  btf.doubleSided = isShape;  // the inside of the cloth shows
  GltfOptions gltf;
  gltf.btf = btf;
  gltf.fields = options.fields ? options.fields : std::make_shared<FieldCache>(options.models);
  gltf.lights = options.lamps.empty() && !options.studio;
  gltf.shadows = options.shadows;
  gltf.time = options.time;
  gltf.animation = options.animation;
  WEFT_TRY_VOID(checkMaps(options));
  WEFT_TRY(const std::vector<GltfScene::FieldMaterial> fields, replacementsOf(options, btf, *gltf.fields));
  std::shared_ptr<const BTFMaterial> ofAll;
  for (const auto& [name, file, material] : fields) {
    gltf.replacements[name] = material;
    if (name == "*") ofAll = material;
  }
  WEFT_TRY(GltfScene scene, isShape ? makeShape(options.scene.substr(kShapePrefix.size()), ofAll)
                                    : loadGltf(options.scene, gltf));
  WEFT_TRY_VOID(checkNames(fields, scene, options.scene));
  return scene;
}

// The radius of a scene; a single point may have any.
double sizeOf(const Bounds& bounds) {
  return bounds.radius() > 0.0 ? bounds.radius() : 1.0;
}

// The cosine of the angle between the middle of a picture and its corner.
double cosineOfCorner(const Camera& camera, float aspect) {
  const double y = std::tan(0.5 * double{camera.verticalFieldOfView}), x = y * double{aspect};
  return 1.0 / std::sqrt(1.0 + x * x + y * y);
}

// A camera at a place of its own, whose clipping planes enclose the scene.
Camera cameraAt(const SceneOptions& options, const GltfScene& scene) {
  const SceneOptions::PointOfView& viewpoint = *options.viewpoint;
  const glm::dvec3 direction = glm::normalize(viewpoint.target - viewpoint.eye);
  const bool vertical = std::abs(direction.y) > 0.999;
  Camera camera =
      Camera::lookAt(viewpoint.eye, viewpoint.target, vertical ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0));
  const double distance = glm::distance(viewpoint.eye, scene.bounds.center());
  const double radius = 1.01 * sizeOf(scene.bounds);
  const double far = distance + radius;
  // Within a scene what is nearest decides, if it stands still and does not touch the eye.
  const double nearest = options.turns ? 0.0 : distanceTo(*scene.root, viewpoint.eye);
  const double nearestDepth =
      nearest > 1e-8 * far ? 0.9 * nearest * cosineOfCorner(camera, options.aspect) : 1e-4 * far;
  const double near = std::max(distance - radius, nearestDepth);
  camera.nearPlane = static_cast<float>(std::min(near, 0.999 * far));
  camera.farPlane = static_cast<float>(far);
  return camera;
}

// The cylinder that a scene does not leave when it turns.
std::shared_ptr<Node> cylinderAround(const Bounds& bounds) {
  const glm::vec3 half = 0.5 * (bounds.maximum - bounds.minimum);
  Mesh cylinder = makeSphere(16);
  for (glm::vec3& p : cylinder.positions) {
    const glm::vec2 across(p.x, p.z);
    const glm::vec2 rim = across * (std::hypot(half.x, half.z) / std::max(glm::length(across), 1e-6f));
    p = glm::vec3(rim.x, std::copysign(half.y, p.y), rim.y);
  }
  const glm::dmat4 place = glm::translate(glm::dmat4(1.0), bounds.center());
  auto node = std::make_shared<Node>(std::make_shared<Transform>(place));
  node->addChild(std::make_shared<Geometry>(std::make_shared<Mesh>(std::move(cylinder))));
  return node;
}

// How many measured lights the slowest of a scene's fields adds up under an environment.
int mostEnvironmentLights(const Node& root) {
  int most = 0;
  traverse(root, [&](const Node& node, const glm::mat4&) {
    const auto* group = dynamic_cast<const MaterialGroup*>(&node.core());
    const auto* field = group ? dynamic_cast<const BTFMaterial*>(group->material().get()) : nullptr;
    if (field) most = std::max(most, field->textures()->environmentLights());
    return Visit::Continue;
  });
  return most;
}

}  // namespace

SceneSetup::SceneSetup(GltfScene scene) : scene_(std::move(scene)) {
  root_->addChild(turn_)->addChild(scene_.root);
  root_->addChild(lampNode_);
}

Result<SceneSetup> SceneSetup::create(const SceneOptions& options) {
  WEFT_TRY(GltfScene scene, loadScene(options));
  SceneSetup setup(std::move(scene));
  setup.shadows_ = options.shadows;
  for (const std::string& warning : setup.scene_.warnings)
    setup.warnings_.push_back(fmt::format("{}: {}", options.scene, warning));
  WEFT_TRY_VOID(setup.chooseCamera(options));
  if (!options.environment.empty()) WEFT_TRY_VOID(setup.addEnvironment(options));
  setup.chooseLamps(options);
  for (std::string& warning : repetitionWarnings(*setup.scene_.root, setup.camera_, options))
    setup.warnings_.push_back(std::move(warning));
  return setup;
}

Result<void> SceneSetup::chooseCamera(const SceneOptions& options) {
  if (options.viewpoint) {
    camera_ = cameraAt(options, scene_);
    return {};
  }
  for (const GltfScene::NamedCamera& named : scene_.cameras)
    if (options.cameraName.empty() || named.name == options.cameraName) {
      camera_ = named.camera;
      return {};
    }
  if (options.cameraName.empty()) {
    const std::shared_ptr<Node> shown = options.turns ? cylinderAround(scene_.bounds) : scene_.root;
    camera_ = frame(*shown, kDefaultView, options.aspect);
    return {};
  }
  std::vector<std::string> names;
  for (const GltfScene::NamedCamera& named : scene_.cameras) names.push_back(named.name);
  return fail("there is no camera \"" + options.cameraName + "\"", options.scene,
              fmt::format("its cameras are {}", names));
}

void SceneSetup::chooseLamps(const SceneOptions& options) {
  std::vector<SceneOptions::Lamp> lamps = options.lamps;
  const bool isDark = lamps.empty() && options.environment.empty() && scene_.lights == 0;
  const glm::dmat3 toWorld = glm::transpose(glm::dmat3(camera_.view));
  const auto add = [&](const SceneOptions::Lamp& lamp) {
    lamps.push_back(
        {scene_.bounds.center() + 4.0 * sizeOf(scene_.bounds) * (toWorld * lamp.place), lamp.color});
  };
  if (options.studio || (isDark && options.defaultLight == SceneOptions::DefaultLight::Studio))
    for (const SceneOptions::Lamp& lamp : kStudio) add(lamp);
  else if (isDark)
    add(kSingleLamp);
  setLamps(std::move(lamps));
}

// As bright as it takes for a white surface at the scene's centre that faces them to show their
// colour.
void SceneSetup::setLamps(std::vector<SceneOptions::Lamp> lamps) {
  lamps_ = std::move(lamps);
  while (!lampNode_->children().empty()) lampNode_->removeChild(*lampNode_->children().back());
  for (const SceneOptions::Lamp& lamp : lamps_) {
    const glm::dvec3 offset = lamp.place - scene_.bounds.center();
    const glm::dvec3 intensity = glm::pi<double>() * glm::dot(offset, offset) * glm::dvec3(lamp.color);
    const auto light = std::make_shared<PointLight>(intensity);
    light->castsShadow = shadows_;
    lampNode_->addChild(std::make_shared<Transform>(glm::translate(glm::dmat4(1.0), lamp.place)))
        ->addChild(light);
  }
}

Result<void> SceneSetup::addEnvironment(const SceneOptions& options) {
  std::vector<std::string> found;
  WEFT_TRY(const Environment environment, environmentNamed(options.environment, found));
  for (const std::string& warning : found) warnings_.push_back(options.environment + ": " + warning);
  if (const int lights = mostEnvironmentLights(*scene_.root); lights > 1)
    warnings_.push_back(
        fmt::format("a reflectance field has no formula for light of an environment: every "
                    "pixel adds up {} measured lights, which is slow",
                    lights));
  const PrefilteredEnvironment prefiltered = prefilter(environment, cacheFolder(), warnings_);
  root_->addChild(environmentTurn_)
      ->addChild(makeEnvironmentLight(environment, prefiltered, options.environmentLobes));
  turnEnvironment(options.environmentRotation);
  return {};
}

void SceneSetup::turnEnvironment(double degrees) {
  // Clockwise as seen on a map: the picture's middle comes to lie to the right of where it was.
  const float angle = glm::radians(-static_cast<float>(std::fmod(degrees, 360.0)));
  environmentTurn_->setMatrix(glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0, 1, 0)));
}

void SceneSetup::turn(double radians) {
  const glm::dvec3 center = scene_.bounds.center();
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), radians, glm::dvec3(0, 1, 0));
  turn_->setMatrix(glm::translate(glm::dmat4(1.0), center) * turned *
                   glm::translate(glm::dmat4(1.0), -center));
}

}  // namespace weft
