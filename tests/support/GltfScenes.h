#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "GltfText.h"
#include "TestScene.h"
#include "TestSupport.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {

using Json = nlohmann::ordered_json;

/// A glTF file in the test's folder.
inline std::filesystem::path writtenGltf(std::string_view text, const std::string& name = "scene.gltf") {
  const std::filesystem::path path = testFolder() / name;
  writeText(path, text);
  return path;
}

inline GltfScene loadedText(std::string_view text, const GltfOptions& options = {}) {
  return valueOf(loadGltf(writtenGltf(text), options));
}

inline GltfScene loadedGltf(const Json& file, const GltfOptions& options = {}) {
  return loadedText(file.dump(), options);
}

/// Why a file is refused.
inline std::string failureOfText(std::string_view text, const GltfOptions& options = {}) {
  const auto scene = loadGltf(writtenGltf(text), options);
  return scene ? "it loaded" : scene.error().message();
}

inline std::string failureOfGltf(const Json& file, const GltfOptions& options = {}) {
  return failureOfText(file.dump(), options);
}

/// A geometry where it stands in the world, with its material.
struct DrawnMesh {
  glm::dmat4 toWorld{1.0};
  std::shared_ptr<const Mesh> mesh{};
  std::shared_ptr<const Material> material{};
};

inline void collectDrawn(const Node& node, DrawnMesh above, std::vector<DrawnMesh>& drawn) {
  if (const auto* transform = dynamic_cast<const Transform*>(&node.core()))
    above.toWorld *= transform->matrix();
  if (const auto* group = dynamic_cast<const MaterialGroup*>(&node.core()))
    above.material = group->material();
  if (const auto* geometry = dynamic_cast<const Geometry*>(&node.core())) {
    above.mesh = geometry->mesh();
    drawn.push_back(above);
  }
  for (const auto& child : node.children()) collectDrawn(*child, above, drawn);
}

/// In the order of the tree.
inline std::vector<DrawnMesh> drawnIn(const GltfScene& scene) {
  std::vector<DrawnMesh> drawn;
  collectDrawn(*scene.root, {}, drawn);
  return drawn;
}

/// A glTF file that is put together member by member: "json" of what GltfText writes, with one node
/// and one mesh of one triangle; its accessor 0 are the positions.
inline Json triangleGltf(const GltfText& buffers) {
  return Json::parse(
      buffers.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
}

/// The same with nothing but its positions.
inline Json triangleGltf() {
  GltfText buffers;
  buffers.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  return triangleGltf(buffers);
}

}  // namespace weft::test
