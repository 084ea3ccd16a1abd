#pragma once

#include <glm/ext/vector_double3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/materials/LightFromEnvironment.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Transform.h"

namespace weft {

/// What to look at, from where, in which light.
struct SceneOptions {
  struct PointOfView {
    glm::dvec3 eye;
    glm::dvec3 target;
  };
  /// A point light under which white at the scene's centre that faces it shows `color`.
  struct Lamp {
    glm::dvec3 place;
    glm::vec3 color;
  };
  /// What lights a scene that has no light: the lamps of `studio`, or the first of them alone, more
  /// from the front, which costs a third of the time.
  enum class DefaultLight { Studio, Lamp };

  std::string scene;  ///< a glTF file, or shape:plane, shape:sphere, shape:cloth
  /// a `.rf.exr` a material; "*" for all not named
  std::map<std::string, std::string> materialFiles{};
  /// a `.coords.exr` for some of those, by the same names
  std::map<std::string, std::string> mapFiles{};
  /// The same of materials that are there already, as of a field that was just fitted.
  std::map<std::string, std::shared_ptr<BTFMaterial>> materials{};
  BTFMaterialOptions btf{};
  ModelRegistry models = ModelRegistry::builtin();  ///< that reflectance fields may be of
  /// Where those come from, instead of models; null: each is read once for this scene.
  std::shared_ptr<FieldCache> fields{};
  std::optional<double> time{};  ///< seconds after the start of an animation
  std::string animation{};       ///< which one; empty: the first
  std::vector<Lamp> lamps{};     ///< instead of the file's lights, if any
  bool studio = false;           ///< adds a key, a fill and a rim lamp to those
  DefaultLight defaultLight = DefaultLight::Studio;
  bool shadows = false;                    ///< whether lamps and the file's lights cast shadows
  std::string cameraName{};                ///< empty: the file's first, or all of the scene
  std::optional<PointOfView> viewpoint{};  ///< instead of a name
  float aspect = 4.0f / 3.0f;              ///< of the picture: width / height
  /// a camera of our own keeps all in the picture while it turns
  bool turns = false;
  std::string environment{};         ///< a file or a built-in name; empty for none
  double environmentRotation = 0.0;  ///< degrees, clockwise seen from above
  LobeLookup environmentLobes = LobeLookup::Fitted;
};

/// A scene that is ready to be drawn: what weft-render and viewers show.
///
/// A studio's lamps stand around the scene as the camera sees it: the key light above left, the
/// fill to the right, the rim light behind.
class SceneSetup {
 public:
  /// Fails, with file and reason, as loadGltf(), loadBTFMaterial() and environmentNamed() do, and
  /// on names of shapes, materials and cameras that are not there. Touches no GL.
  static Result<SceneSetup> create(const SceneOptions& options);

  const Node& root() const { return *root_; }
  const Camera& camera() const { return camera_; }
  const GltfScene& scene() const { return scene_; }
  const std::vector<std::string>& warnings() const { return warnings_; }  ///< a sentence each
  /// Those that the options asked for, or the default light's; not the file's lights.
  const std::vector<SceneOptions::Lamp>& lamps() const { return lamps_; }
  /// Shows other lamps instead of these.
  void setLamps(std::vector<SceneOptions::Lamp> lamps);
  /// Turns the environment, if there is one, as SceneOptions::environmentRotation says.
  void turnEnvironment(double degrees);
  /// Turns the scene around its vertical axis, counter-clockwise seen from above; lights and camera
  /// stay.
  void turn(double radians);

 private:
  explicit SceneSetup(GltfScene scene);
  Result<void> chooseCamera(const SceneOptions& options);
  void chooseLamps(const SceneOptions& options);
  Result<void> addEnvironment(const SceneOptions& options);

  GltfScene scene_;
  /// of what stays while the scene turns, too
  std::shared_ptr<Node> root_ = std::make_shared<Node>();
  std::shared_ptr<Transform> turn_ = std::make_shared<Transform>();
  std::shared_ptr<Node> lampNode_ = std::make_shared<Node>();
  std::shared_ptr<Transform> environmentTurn_ = std::make_shared<Transform>();
  Camera camera_;
  std::vector<SceneOptions::Lamp> lamps_;
  bool shadows_ = false;  ///< of lamps
  std::vector<std::string> warnings_;
};

}  // namespace weft
