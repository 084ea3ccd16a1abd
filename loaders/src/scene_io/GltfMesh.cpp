#include "GltfMesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <type_traits>

#include "weft/scenegraph/Tangents.h"

namespace weft {
namespace {

/// An attribute as vectors; empty where the primitive does not have it.
template <class Vector>
Result<std::vector<Vector>> readAttribute(const GltfFile& file, const tinygltf::Primitive& primitive,
                                          const std::string& name) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return std::vector<Vector>();
  constexpr std::size_t components = static_cast<std::size_t>(Vector::length());
  WEFT_TRY(const std::vector<float> values, readFloats(file, found->second, components));
  std::vector<Vector> vectors(values.size() / components);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (std::size_t k = 0; k < components; ++k)
      vectors[i][static_cast<typename Vector::length_type>(k)] = values[i * components + k];
  return vectors;
}

Result<std::vector<std::uint32_t>> readTriangles(const GltfFile& file, const tinygltf::Primitive& primitive,
                                                 std::size_t vertexCount) {
  std::vector<std::uint32_t> indices(vertexCount);
  std::iota(indices.begin(), indices.end(), 0u);
  if (primitive.indices >= 0) {
    WEFT_TRY(indices, readIndices(file, primitive.indices));
  }
  if (indices.size() % 3 != 0) return file.fail("a mesh's number of vertices is not a multiple of three");
  for (const std::uint32_t index : indices)
    if (index >= vertexCount)
      return file.fail("a mesh has index " + std::to_string(index) + ", but only " +
                       std::to_string(vertexCount) + " vertices");
  return indices;
}

/// Unit normals; one without length, which glTF forbids, becomes +Z.
void normalize(std::vector<glm::vec3>& normals) {
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0.0f && std::isfinite(length) ? normal / length : glm::vec3(0, 0, 1);
  }
}

/// Unit tangents with w = +1 or -1; false where one has no length.
bool normalize(std::vector<glm::vec4>& tangents) {
  for (glm::vec4& tangent : tangents) {
    const float length = glm::length(glm::vec3(tangent));
    if (!(length > 0.0f) || !std::isfinite(length)) return false;
    tangent = glm::vec4(glm::vec3(tangent) / length, tangent.w < 0.0f ? -1.0f : 1.0f);
  }
  return true;
}

}  // namespace

Result<std::shared_ptr<const Mesh>> readMesh(const GltfFile& file, const tinygltf::Primitive& primitive) {
  Mesh mesh;
  WEFT_TRY(mesh.positions, readAttribute<glm::vec3>(file, primitive, "POSITION"));
  WEFT_TRY(mesh.normals, readAttribute<glm::vec3>(file, primitive, "NORMAL"));
  WEFT_TRY(mesh.tangents, readAttribute<glm::vec4>(file, primitive, "TANGENT"));
  WEFT_TRY(mesh.texcoords, readAttribute<glm::vec2>(file, primitive, "TEXCOORD_0"));
  WEFT_TRY(mesh.indices, readTriangles(file, primitive, mesh.positions.size()));
  const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
  if (!fits(mesh.normals.size()) || !fits(mesh.tangents.size()) || !fits(mesh.texcoords.size()))
    return file.fail("the attributes of a mesh differ in length");

  mesh.texcoords.resize(mesh.positions.size(), glm::vec2(0));
  if (mesh.normals.empty()) {
    mesh.tangents.clear();  // glTF: they belong to normals that are not there
    generateNormals(mesh, NormalKind::Flat);
  }
  normalize(mesh.normals);
  if (mesh.tangents.empty() || !normalize(mesh.tangents)) generateTangents(mesh);
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace weft
