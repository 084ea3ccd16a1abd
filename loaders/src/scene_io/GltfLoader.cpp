#include "weft/scene_io/GltfLoader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "GltfAccessor.h"
#include "GltfDraco.h"
#include "GltfFile.h"
#include "GltfInstances.h"
#include "GltfLights.h"
#include "GltfMaterials.h"
#include "GltfMesh.h"
#include "GltfMeshopt.h"
#include "GltfPose.h"
#include "weft/core/PrintableText.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

constexpr int kDeepestNode = 1000;
constexpr std::size_t kNodeMemory = 256;   // with its core, and what drawing it takes
constexpr double kLargestRadius = 1e15;    // squares of distances, times light, are floats ...
constexpr double kSmallestRadius = 1e-15;  // ... and not 0
// From the origin, in radii: doubles tell places in the scene apart.
constexpr double kFarthest = 1e13;

/// A node of the file that is still to be read.
struct PendingNode {
  int index;
  std::shared_ptr<Node> parent;
  glm::dmat4 toWorld;
  int depth;
};

/// A node of the scene.
struct Placed {
  std::shared_ptr<Node> node;
  glm::dmat4 toWorld;
};

/// The inverse of a camera node's matrix without its scale, which glTF says to leave out.
std::optional<glm::dmat4> viewOf(const glm::dmat4& toWorld) {
  glm::dmat4 rigid = toWorld;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(glm::dvec3(toWorld[axis]));
    if (!(length > 0.0)) return std::nullopt;
    rigid[axis] = toWorld[axis] / length;
  }
  const glm::dmat4 view = glm::inverse(rigid);
  if (!isFinite(view)) return std::nullopt;  // two axes are one
  return view;
}

/// A camera without a place; a perspective one may lack a far plane, which is then 0.
std::optional<Camera> lensOf(const tinygltf::Camera& source) {
  constexpr double kLargest = 1e30;
  Camera camera;
  if (source.type == "perspective") {
    const tinygltf::PerspectiveCamera& lens = source.perspective;
    if (!(lens.yfov > 0.0 && lens.yfov < 3.1 && lens.znear > 0.0 && lens.zfar < kLargest) ||
        (lens.zfar != 0.0 && lens.zfar <= lens.znear))
      return std::nullopt;
    camera.verticalFieldOfView = static_cast<float>(lens.yfov);
    camera.nearPlane = static_cast<float>(lens.znear);
    camera.farPlane = static_cast<float>(lens.zfar);
  } else {
    // The width follows the picture, as with a perspective one.
    const tinygltf::OrthographicCamera& lens = source.orthographic;
    if (!(lens.ymag > 0.0 && lens.ymag < kLargest && lens.znear >= 0.0 && lens.zfar > lens.znear &&
          lens.zfar < kLargest))
      return std::nullopt;
    camera.orthographicHeight = static_cast<float>(2.0 * lens.ymag);
    camera.nearPlane = static_cast<float>(lens.znear);
    camera.farPlane = static_cast<float>(lens.zfar);
  }
  return camera;
}

class SceneReader {
 public:
  SceneReader(const GltfFile& file, GltfPose pose, const GltfOptions& options)
      : file_(file), pose_(std::move(pose)), options_(options), materials_(file_, options, scene_.warnings) {}
  SceneReader(const SceneReader&) = delete;
  SceneReader& operator=(const SceneReader&) = delete;

  Result<GltfScene> read() {
    scene_.root = std::make_shared<Node>();
    warnOfTheFile();
    WEFT_TRY(scene_.animations, animationsOf(file_));
    WEFT_TRY_VOID(placeNodes());
    for (const int index : order_) WEFT_TRY_VOID(addContents(index));
    scene_.materials = materials_.names();
    scene_.fields = materials_.fields();
    scene_.files = file_.namedFiles;
    scene_.bounds = boundsOf(*scene_.root);
    if (scene_.bounds.empty()) return file_.fail("the scene draws nothing");
    WEFT_TRY_VOID(checkSize());
    setFarPlanes();
    tidyWarnings();
    scene_.data = file_.contents.data;
    WEFT_TRY_VOID(callExtensions());
    return std::move(scene_);
  }

 private:
  void warn(std::string warning) { scene_.warnings.push_back(std::move(warning)); }

  void warnOfTheFile() {
    scene_.warnings = file_.warnings;
    for (const std::string& extension : file_.model.extensionsUsed) {
      // What is packed is unpacked, or refused; or the file has it unpacked, too.
      const bool isPacking = extension == kDracoExtension || extension == kMeshoptExtension;
      if (!isPacking && !isKnownExtension(extension) && !options_.extensions.contains(extension))
        warn("what " + extension + " says is not shown");
    }
    if (!file_.model.animations.empty() && !options_.time) warn("animations stand still, no time is given");
  }

  /// As text for people, each once: many meshes may have the same fault.
  void tidyWarnings() {
    std::set<std::string> told;
    std::vector<std::string> tidy;
    for (const std::string& warning : scene_.warnings)
      if (std::string text = printable(warning); told.insert(text).second) tidy.push_back(std::move(text));
    scene_.warnings = std::move(tidy);
  }

  Result<void> checkSize() const {
    const double radius = scene_.bounds.radius(), distance = glm::length(scene_.bounds.center());
    const bool small = radius < kSmallestRadius;
    if (radius != 0.0 && !(radius >= kSmallestRadius && radius <= kLargestRadius))
      return file_.fail(
          fmt::format("the scene is too {}, {:.1g} across", small ? "small" : "large", 2.0 * radius));
    if (radius != 0.0 && distance > kFarthest * radius)
      return file_.fail(fmt::format("the scene is too far from its origin, {:.1g}, for its size of {:.1g}",
                                    distance, 2.0 * radius));
    return {};
  }

  /// Makes the nodes of the scene, still without contents, in the order of the file's tree.
  Result<void> placeNodes() {
    const tinygltf::Model& model = file_.model;
    if (model.scenes.empty()) return file_.fail("the file has no scene");
    const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
    if (scene >= model.scenes.size()) return file_.fail("the default scene does not exist");
    const std::vector<int>& roots = model.scenes[scene].nodes;
    std::vector<PendingNode> visits;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
      visits.push_back({*root, scene_.root, glm::dmat4(1.0), 0});
    while (!visits.empty()) {
      const PendingNode visit = visits.back();
      visits.pop_back();
      const std::string name = "node " + std::to_string(visit.index);
      if (visit.index < 0 || static_cast<std::size_t>(visit.index) >= model.nodes.size())
        return file_.fail(name + " does not exist");
      if (placed_.contains(visit.index)) return file_.fail(name + " has two parents or is in a cycle");
      if (visit.depth > kDeepestNode) return file_.fail("the nodes are nested too deeply");
      const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(visit.index)];
      WEFT_TRY(const glm::dmat4 matrix, pose_.matrix(visit.index));
      const glm::dmat4 toWorld = visit.toWorld * matrix;
      if (!isFinite(toWorld)) return file_.fail(name + " has a broken transform");
      const auto placed = visit.parent->addChild(std::make_shared<Transform>(matrix), node.name);
      placed_[visit.index] = {placed, toWorld};
      order_.push_back(visit.index);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        visits.push_back({*child, placed, toWorld, visit.depth + 1});
    }
    return {};
  }

  Result<void> addContents(int index) {
    const tinygltf::Node& node = file_.model.nodes[static_cast<std::size_t>(index)];
    const Placed& placed = placed_.at(index);
    if (node.mesh >= 0) WEFT_TRY_VOID(addMesh(index, node, *placed.node));
    if (node.camera >= 0) WEFT_TRY_VOID(addCamera(node, placed.toWorld));
    if (options_.lights && node.extensions.contains(kLightExtension))
      WEFT_TRY_VOID(addLight(node.extensions.at(kLightExtension), *placed.node));
    return {};
  }

  /// Cores that all nodes with the same mesh share.
  struct Primitive {
    std::shared_ptr<const MaterialGroup> material;
    std::shared_ptr<const Geometry> geometry;
  };

  Result<void> addMesh(int index, const tinygltf::Node& node, Node& placed) {
    if (static_cast<std::size_t>(node.mesh) >= file_.model.meshes.size())
      return file_.fail("mesh " + std::to_string(node.mesh) + " does not exist");
    const tinygltf::Mesh& mesh = file_.model.meshes[static_cast<std::size_t>(node.mesh)];
    MeshPose pose{.morphWeights = pose_.morphWeights(index)};
    const auto instancing = node.extensions.find(kInstancingExtension);
    if (node.skin >= 0) {
      WEFT_TRY(const std::vector<glm::dmat4> joints, jointsOf(node.skin));
      // A skin places its vertices in the world; glTF says not to heed where the node stands. As
      // floats they must be near something: where the first joint puts the mesh's origin.
      const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(joints.front()[3]));
      for (const glm::dmat4& joint : joints) pose.joints.emplace_back(glm::inverse(place) * joint);
      WEFT_TRY(const std::vector<Primitive> primitives, readPrimitives(mesh, pose));
      addPrimitives(primitives, *scene_.root->addChild(std::make_shared<Transform>(place)));
      if (instancing != node.extensions.end()) warn("a mesh with a skin is shown without its instances");
      return {};
    }
    WEFT_TRY(const std::vector<Primitive> primitives, readPrimitives(mesh, pose));
    if (instancing == node.extensions.end()) {
      addPrimitives(primitives, placed);
      return {};
    }
    return addInstances(instancing->second, primitives, placed);
  }

  Result<void> addInstances(const tinygltf::Value& extension, const std::vector<Primitive>& primitives,
                            Node& placed) {
    WEFT_TRY(const std::vector<glm::mat4> instances, instancesOf(file_, extension));
    taken_ += instances.size() * (1 + 2 * primitives.size()) * kNodeMemory;
    WEFT_TRY_VOID(file_.checkMemory(taken_, "the meshes and their instances"));
    for (const glm::mat4& instance : instances)
      addPrimitives(primitives, *placed.addChild(std::make_shared<Transform>(instance)));
    return {};
  }

  static void addPrimitives(const std::vector<Primitive>& primitives, Node& parent) {
    for (const Primitive& primitive : primitives)
      parent.addChild(primitive.material)->addChild(primitive.geometry);
  }

  Result<std::vector<Primitive>> readPrimitives(const tinygltf::Mesh& mesh, const MeshPose& pose) {
    std::vector<Primitive> primitives;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!primitive.attributes.contains("POSITION")) continue;  // glTF: it is not drawn
      WEFT_TRY(const MeshDress dress, materials_.get(primitive.material, wearerOf(file_, primitive)));
      WEFT_TRY(std::shared_ptr<const Geometry> geometry, geometryOf(primitive, dress, pose));
      primitives.push_back({std::make_shared<MaterialGroup>(dress.material), std::move(geometry)});
    }
    return primitives;
  }

  /// Shared by all primitives that become the same mesh, whatever their materials are.
  Result<std::shared_ptr<const Geometry>> geometryOf(const tinygltf::Primitive& primitive,
                                                     const MeshDress& dress, const MeshPose& pose) {
    const std::string key = meshKey(primitive, dress, pose);
    if (const auto found = geometries_.find(key); found != geometries_.end() && pose.joints.empty())
      return found->second;
    WEFT_TRY(std::shared_ptr<const Mesh> mesh,
             readMesh(file_, primitive, dress, pose, taken_, scene_.warnings));
    auto geometry = std::make_shared<const Geometry>(std::move(mesh));
    if (pose.joints.empty()) geometries_[key] = geometry;
    return geometry;
  }

  /// Vertex to world, for every joint of a skin.
  Result<std::vector<glm::dmat4>> jointsOf(int index) {
    const std::string name = "skin " + std::to_string(index);
    if (static_cast<std::size_t>(index) >= file_.model.skins.size())
      return file_.fail(name + " does not exist");
    const tinygltf::Skin& skin = file_.model.skins[static_cast<std::size_t>(index)];
    std::vector<glm::mat4> toJoint(skin.joints.size(), glm::mat4(1.0f));
    if (skin.inverseBindMatrices >= 0) {
      WEFT_TRY(toJoint, (readVectors<glm::mat4, 16>(file_, skin.inverseBindMatrices)));
    }
    if (skin.joints.empty() || toJoint.size() < skin.joints.size())
      return file_.fail(name + " has no joints, or less matrices than joints");
    std::vector<glm::dmat4> joints;
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const auto joint = placed_.find(skin.joints[i]);
      if (joint == placed_.end()) return file_.fail(name + " has a joint that is not in the scene");
      joints.push_back(joint->second.toWorld * glm::dmat4(toJoint[i]));
    }
    return joints;
  }

  Result<void> addCamera(const tinygltf::Node& node, const glm::dmat4& toWorld) {
    const std::string index = std::to_string(node.camera);
    if (static_cast<std::size_t>(node.camera) >= file_.model.cameras.size())
      return file_.fail("camera " + index + " does not exist");
    const tinygltf::Camera& source = file_.model.cameras[static_cast<std::size_t>(node.camera)];
    const std::optional<glm::dmat4> view = viewOf(toWorld);
    const std::optional<Camera> lens = lensOf(source);
    if (!view || !lens) return file_.fail("camera " + index + " is not a valid camera");
    Camera camera = *lens;
    camera.view = *view;
    scene_.cameras.push_back({source.name.empty() ? node.name : source.name, camera});
    return {};
  }

  Result<void> addLight(const tinygltf::Value& extension, Node& placed) {
    WEFT_TRY(std::shared_ptr<Light> core,
             lightFrom(file_, extension.Get("light").GetNumberAsInt(), scene_.warnings));
    core->castsShadow = options_.shadows;
    placed.addChild(std::move(core));
    ++scene_.lights;
    return {};
  }

  /// A camera may leave its far plane out; then it sees the whole scene.
  void setFarPlanes() {
    for (GltfScene::NamedCamera& named : scene_.cameras) {
      Camera& camera = named.camera;
      if (camera.farPlane > 0.0f) continue;
      const double distance = glm::distance(camera.position(), scene_.bounds.center());
      camera.farPlane =
          std::max(static_cast<float>(distance + 1.01 * scene_.bounds.radius()), 2.0f * camera.nearPlane);
    }
  }

  /// Hands the program what it knows better, in the order of the file.
  Result<void> callExtensions() {
    constexpr std::string_view nodes = "/nodes/";
    for (const GltfData& data : scene_.data) {
      const auto handler = options_.extensions.find(data.name);
      if (handler == options_.extensions.end()) continue;
      int index = -1;
      if (data.place.starts_with(nodes)) {
        const char* end = data.place.data() + data.place.size();
        const auto [rest, error] = std::from_chars(data.place.data() + nodes.size(), end, index);
        if (error != std::errc() || rest != end) index = -1;
      }
      const auto placed = placed_.find(index);
      WEFT_TRY_VOID(handler->second(data, placed == placed_.end() ? nullptr : placed->second.node.get()));
    }
    return {};
  }

  const GltfFile& file_;
  GltfPose pose_;
  const GltfOptions& options_;
  GltfScene scene_;
  GltfMaterials materials_;
  std::map<int, Placed> placed_;                                       ///< by the file's number
  std::vector<int> order_;                                             ///< of the nodes in the tree
  std::map<std::string, std::shared_ptr<const Geometry>> geometries_;  ///< by meshKey()
  std::size_t taken_ = 0;                                              ///< bytes of all of them
};

}  // namespace

Result<GltfScene> loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
  WEFT_TRY(const GltfFile file, readGltfFile(path, options));
  WEFT_TRY(GltfPose pose, GltfPose::create(file, options));
  return SceneReader(file, std::move(pose), options).read();
}

}  // namespace weft
