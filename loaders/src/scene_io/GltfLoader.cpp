#include "weft/scene_io/GltfLoader.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <utility>

#include "GltfFile.h"
#include "GltfMaterials.h"
#include "GltfMesh.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

constexpr int kDeepestNode = 1000;
constexpr std::size_t kMostVertices = 100'000'000;
constexpr const char* kLightExtension = "KHR_lights_punctual";

/// A node of the file that is still to be read.
struct Visit {
  int index;
  std::shared_ptr<Node> parent;
  glm::mat4 toWorld;
  int depth;
};

bool isFinite(const glm::mat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row])) return false;
  return true;
}

std::optional<glm::mat4> matrixOf(const tinygltf::Node& node) {
  const auto sizeIs = [](const std::vector<double>& values, std::size_t size) {
    return values.empty() || values.size() == size;
  };
  if (!sizeIs(node.matrix, 16) || !sizeIs(node.translation, 3) || !sizeIs(node.rotation, 4) ||
      !sizeIs(node.scale, 3))
    return std::nullopt;
  glm::mat4 matrix(1.0f);
  if (!node.matrix.empty()) {
    for (std::size_t i = 0; i < 16; ++i)
      matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = static_cast<float>(node.matrix[i]);
  } else {
    if (!node.translation.empty())
      matrix =
          glm::translate(matrix, glm::vec3(node.translation[0], node.translation[1], node.translation[2]));
    if (!node.rotation.empty()) {
      const std::vector<double>& r = node.rotation;
      matrix *= glm::mat4(glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]))));
    }
    if (!node.scale.empty())
      matrix = glm::scale(matrix, glm::vec3(node.scale[0], node.scale[1], node.scale[2]));
  }
  if (!isFinite(matrix)) return std::nullopt;
  return matrix;
}

/// The inverse of a camera node's matrix without its scale, which glTF says to leave out.
std::optional<glm::mat4> viewOf(const glm::mat4& toWorld) {
  glm::mat4 rigid = toWorld;
  for (int axis = 0; axis < 3; ++axis) {
    const float length = glm::length(glm::vec3(toWorld[axis]));
    if (!(length > 0.0f)) return std::nullopt;
    rigid[axis] = toWorld[axis] / length;
  }
  const glm::mat4 view = glm::inverse(rigid);
  if (!isFinite(view)) return std::nullopt;  // two axes are one
  return view;
}

class SceneReader {
 public:
  SceneReader(GltfFile file, const GltfOptions& options)
      : file_(std::move(file)), options_(options), materials_(file_, options, scene_.warnings) {}
  SceneReader(const SceneReader&) = delete;
  SceneReader& operator=(const SceneReader&) = delete;

  Result<GltfScene> read() {
    scene_.root = std::make_shared<Node>();
    WEFT_TRY_VOID(readNodes());
    if (!file_.model.animations.empty()) warn("animations are not played");
    if (!file_.model.skins.empty()) warn("skins are ignored: meshes stand as they were modelled");
    scene_.materials = materials_.names();
    scene_.bounds = boundsOf(*scene_.root);
    if (scene_.bounds.empty()) return file_.fail("the scene draws no triangles");
    if (!std::isfinite(scene_.bounds.radius())) return file_.fail("the scene is too large");
    setFarPlanes();
    return std::move(scene_);
  }

 private:
  void warn(std::string warning) { scene_.warnings.push_back(std::move(warning)); }

  Result<void> readNodes() {
    const tinygltf::Model& model = file_.model;
    if (model.scenes.empty()) return file_.fail("the file has no scene");
    const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
    if (scene >= model.scenes.size()) return file_.fail("the default scene does not exist");
    const std::vector<int>& roots = model.scenes[scene].nodes;
    std::vector<bool> visited(model.nodes.size());
    std::vector<Visit> visits;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
      visits.push_back({*root, scene_.root, glm::mat4(1.0f), 0});
    while (!visits.empty()) {
      const Visit visit = visits.back();
      visits.pop_back();
      const std::string name = "node " + std::to_string(visit.index);
      if (visit.index < 0 || static_cast<std::size_t>(visit.index) >= model.nodes.size())
        return file_.fail(name + " does not exist");
      if (visited[static_cast<std::size_t>(visit.index)])
        return file_.fail(name + " has two parents or is in a cycle");
      visited[static_cast<std::size_t>(visit.index)] = true;
      if (visit.depth > kDeepestNode) return file_.fail("the nodes are nested too deeply");
      const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(visit.index)];
      const std::optional<glm::mat4> matrix = matrixOf(node);
      const glm::mat4 toWorld = matrix ? visit.toWorld * *matrix : glm::mat4(1.0f);
      if (!matrix || !isFinite(toWorld)) return file_.fail(name + " has a broken transform");
      const auto placed = visit.parent->addChild(std::make_shared<Transform>(*matrix), node.name);
      WEFT_TRY_VOID(addContents(node, *placed, toWorld));
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        visits.push_back({*child, placed, toWorld, visit.depth + 1});
    }
    return {};
  }

  Result<void> addContents(const tinygltf::Node& node, Node& placed, const glm::mat4& toWorld) {
    if (node.mesh >= 0) WEFT_TRY_VOID(addMesh(node.mesh, placed));
    if (node.camera >= 0) WEFT_TRY_VOID(addCamera(node, toWorld));
    if (options_.lights && node.extensions.contains(kLightExtension))
      WEFT_TRY_VOID(addLight(node.extensions.at(kLightExtension), placed));
    return {};
  }

  Result<void> addMesh(int index, Node& placed) {
    if (static_cast<std::size_t>(index) >= file_.model.meshes.size())
      return file_.fail("mesh " + std::to_string(index) + " does not exist");
    if (!meshes_.contains(index)) {
      WEFT_TRY(meshes_[index], readPrimitives(file_.model.meshes[static_cast<std::size_t>(index)]));
    }
    for (const Primitive& primitive : meshes_[index])
      placed.addChild(primitive.material)->addChild(primitive.geometry);
    return {};
  }

  /// Cores that all nodes with the same mesh share.
  struct Primitive {
    std::shared_ptr<const MaterialGroup> material;
    std::shared_ptr<const Geometry> geometry;
  };

  Result<std::vector<Primitive>> readPrimitives(const tinygltf::Mesh& mesh) {
    std::vector<Primitive> primitives;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.mode != -1 && primitive.mode != TINYGLTF_MODE_TRIANGLES) {
        warn("mesh \"" + mesh.name + "\" has points, lines, strips or fans, which are not drawn");
        continue;
      }
      if (!primitive.attributes.contains("POSITION")) continue;  // glTF: it is not drawn
      if (!primitive.attributes.contains("TEXCOORD_0"))
        warn("mesh \"" + mesh.name + "\" has no texture coordinates: it shows a single texel");
      WEFT_TRY(std::shared_ptr<const Mesh> triangles, readMesh(file_, primitive));
      vertices_ += triangles->positions.size() + triangles->indices.size();
      if (vertices_ > kMostVertices) return file_.fail("the scene has too many vertices");
      WEFT_TRY(std::shared_ptr<const Material> material, materials_.get(primitive.material));
      primitives.push_back({std::make_shared<MaterialGroup>(std::move(material)),
                            std::make_shared<Geometry>(std::move(triangles))});
    }
    return primitives;
  }

  Result<void> addCamera(const tinygltf::Node& node, const glm::mat4& toWorld) {
    const std::string index = std::to_string(node.camera);
    if (static_cast<std::size_t>(node.camera) >= file_.model.cameras.size())
      return file_.fail("camera " + index + " does not exist");
    const tinygltf::Camera& source = file_.model.cameras[static_cast<std::size_t>(node.camera)];
    if (source.type != "perspective") {
      warn("camera \"" + source.name + "\" is left out, it is not a perspective one");
      return {};
    }
    const std::optional<glm::mat4> view = viewOf(toWorld);
    const tinygltf::PerspectiveCamera& lens = source.perspective;
    const bool valid = view && lens.yfov > 0.0 && lens.yfov < 3.1 && lens.znear > 0.0 &&
                       (lens.zfar == 0.0 || lens.zfar > lens.znear) && lens.zfar < 1e30;
    if (!valid) return file_.fail("camera " + index + " is not a valid perspective camera");
    Camera camera;
    camera.view = *view;
    camera.verticalFieldOfView = static_cast<float>(lens.yfov);
    camera.nearPlane = static_cast<float>(lens.znear);
    camera.farPlane = static_cast<float>(lens.zfar);
    scene_.cameras.push_back({source.name.empty() ? node.name : source.name, camera});
    return {};
  }

  Result<void> addLight(const tinygltf::Value& extension, Node& placed) {
    const int index = extension.IsObject() && extension.Get("light").IsNumber()
                          ? extension.Get("light").GetNumberAsInt()
                          : -1;
    if (index < 0 || static_cast<std::size_t>(index) >= file_.model.lights.size())
      return file_.fail("a node names a light that does not exist");
    const tinygltf::Light& light = file_.model.lights[static_cast<std::size_t>(index)];
    if (light.type != "point" && light.type != "directional") {
      warn("light \"" + light.name + "\" is left out, it is neither a point nor a directional one");
      return {};
    }
    glm::vec3 intensity(static_cast<float>(light.intensity));
    if (light.color.size() == 3) intensity *= glm::vec3(light.color[0], light.color[1], light.color[2]);
    const bool valid = (light.color.empty() || light.color.size() == 3) && intensity.x >= 0.0f &&
                       intensity.y >= 0.0f && intensity.z >= 0.0f && std::isfinite(glm::length(intensity));
    if (!valid) return file_.fail("light " + std::to_string(index) + " has a broken colour or intensity");
    if (light.type == "point")
      placed.addChild(std::make_shared<PointLight>(intensity));
    else
      placed.addChild(std::make_shared<DirectionalLight>(intensity));
    ++scene_.lights;
    return {};
  }

  /// A camera may leave its far plane out; then it sees the whole scene.
  void setFarPlanes() {
    for (GltfScene::NamedCamera& named : scene_.cameras) {
      Camera& camera = named.camera;
      if (camera.farPlane > 0.0f) continue;
      const float distance = glm::distance(camera.position(), scene_.bounds.center());
      camera.farPlane = std::max(distance + 1.01f * scene_.bounds.radius(), 2.0f * camera.nearPlane);
    }
  }

  GltfFile file_;
  const GltfOptions& options_;
  GltfScene scene_;
  GltfMaterials materials_;
  std::map<int, std::vector<Primitive>> meshes_;
  std::size_t vertices_ = 0;
};

}  // namespace

Result<GltfScene> loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
  WEFT_TRY(GltfFile file, readGltfFile(path));
  return SceneReader(std::move(file), options).read();
}

}  // namespace weft
