#include "GltfMesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "GltfAccessor.h"
#include "weft/scenegraph/Tangents.h"

namespace weft {
namespace {

using Attributes = std::map<std::string, int>;

/// The vertices of a primitive: how many its attributes have, and which of them its indices use,
/// where those are not all. Many primitives may share one long list.
struct Vertices {
  std::size_t listed = 0;
  ElementChoice used{};

  std::size_t count() const { return used ? used->size() : listed; }
};

/// Vectors of an attribute; empty where the primitive does not have it, otherwise one a vertex.
template <class Vector>
Result<std::vector<Vector>> readAttribute(const GltfFile& file, const Attributes& attributes,
                                          const std::string& name, const Vertices& vertices) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return std::vector<Vector>();
  WEFT_TRY(const std::size_t listed, countOf(file, found->second));
  if (listed != vertices.listed) return file.fail("the attributes of a mesh differ in length");
  return readVectors<Vector>(file, found->second, vertices.used);
}

/// Vertex colours may lack their alpha.
Result<std::vector<glm::vec4>> readColors(const GltfFile& file, const Attributes& attributes,
                                          const Vertices& vertices) {
  const auto found = attributes.find("COLOR_0");
  if (found == attributes.end()) return std::vector<glm::vec4>();
  WEFT_TRY(const std::size_t components, componentsOf(file, found->second));
  if (components == 4) return readAttribute<glm::vec4>(file, attributes, "COLOR_0", vertices);
  WEFT_TRY(const std::vector<glm::vec3> opaque,
           readAttribute<glm::vec3>(file, attributes, "COLOR_0", vertices));
  std::vector<glm::vec4> colors;
  for (const glm::vec3 color : opaque) colors.emplace_back(color, 1.0f);
  return colors;
}

/// Adds the weighted differences of the morph targets.
template <class Vector>
Result<void> morph(const GltfFile& file, const tinygltf::Primitive& primitive, const std::string& name,
                   const std::vector<float>& weights, const Vertices& vertices,
                   std::vector<Vector>& attribute) {
  for (std::size_t target = 0; target < std::min(weights.size(), primitive.targets.size()); ++target) {
    if (weights[target] == 0.0f || attribute.empty()) continue;
    WEFT_TRY(const std::vector<glm::vec3> differences,
             readAttribute<glm::vec3>(file, primitive.targets[target], name, vertices));
    for (std::size_t i = 0; i < differences.size(); ++i)
      for (int k = 0; k < 3; ++k) attribute[i][k] += weights[target] * differences[i][k];
  }
  return {};
}

/// For every vertex the mean of its joints' matrices.
Result<std::vector<glm::mat4>> skinMatrices(const GltfFile& file, const Attributes& attributes,
                                            const std::vector<glm::mat4>& joints, const Vertices& vertices) {
  const std::size_t vertexCount = vertices.count();
  std::vector<glm::mat4> sums(vertexCount, glm::mat4(0.0f));
  std::vector<float> total(vertexCount, 0.0f);
  for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
    const std::string number = std::to_string(set);
    WEFT_TRY(const std::vector<glm::vec4> indices,
             readAttribute<glm::vec4>(file, attributes, "JOINTS_" + number, vertices));
    WEFT_TRY(const std::vector<glm::vec4> weights,
             readAttribute<glm::vec4>(file, attributes, "WEIGHTS_" + number, vertices));
    if (weights.empty()) return file.fail("a mesh has joints without weights");
    for (std::size_t i = 0; i < vertexCount; ++i)
      for (int k = 0; k < 4; ++k) {
        if (weights[i][k] == 0.0f) continue;
        const float joint = indices[i][k];
        if (!(joint >= 0.0f && joint < static_cast<float>(joints.size())))
          return file.fail("a mesh names a joint that its skin does not have");
        sums[i] += weights[i][k] * joints[static_cast<std::size_t>(joint)];
        total[i] += weights[i][k];
      }
  }
  for (std::size_t i = 0; i < vertexCount; ++i)
    sums[i] = total[i] != 0.0f ? sums[i] / total[i] : joints.front();
  return sums;
}

/// The inverse transpose but for a factor, whose sign is the determinant's.
glm::mat3 cofactors(const glm::mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

/// Moves every vertex by its matrix.
void skin(Mesh& mesh, const std::vector<glm::mat4>& matrices) {
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::mat3 linear(matrices[i]);
    const float sign = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;
    mirrored += sign < 0.0f;
    mesh.positions[i] = glm::vec3(matrices[i] * glm::vec4(mesh.positions[i], 1.0f));
    if (!mesh.normals.empty()) mesh.normals[i] = sign * cofactors(linear) * mesh.normals[i];
    if (!mesh.tangents.empty())
      mesh.tangents[i] = glm::vec4(linear * glm::vec3(mesh.tangents[i]), sign * mesh.tangents[i].w);
  }
  // A mirrored skin shows its triangles from behind.
  if (2 * mirrored > mesh.positions.size() && mesh.topology == Topology::Triangles)
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

/// A primitive's mode and vertices as whole triangles, lines or points.
struct IndexList {
  Topology topology = Topology::Triangles;
  std::vector<std::uint32_t> indices{};
};

Result<IndexList> asList(const GltfFile& file, int mode, const std::vector<std::uint32_t>& v) {
  const std::size_t count = v.size();
  const auto notMultipleOf = [&](const char* number) {
    return file.fail(std::string("a mesh's number of vertices is not a multiple of ") + number);
  };
  switch (mode) {
    case TINYGLTF_MODE_POINTS:
      return IndexList{Topology::Points, v};
    case TINYGLTF_MODE_LINE:
      if (count % 2 != 0) return notMultipleOf("two");
      return IndexList{Topology::Lines, v};
    case -1:
    case TINYGLTF_MODE_TRIANGLES:
      if (count % 3 != 0) return notMultipleOf("three");
      return IndexList{Topology::Triangles, v};
    case TINYGLTF_MODE_LINE_STRIP:
    case TINYGLTF_MODE_LINE_LOOP: {
      if (count < 2) return file.fail("a mesh has a line of a single vertex");
      IndexList list{Topology::Lines};
      for (std::size_t i = 0; i + 1 < count; ++i) list.indices.insert(list.indices.end(), {v[i], v[i + 1]});
      if (mode == TINYGLTF_MODE_LINE_LOOP) list.indices.insert(list.indices.end(), {v.back(), v.front()});
      return list;
    }
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN: {
      if (count < 3) return file.fail("a mesh has a strip or fan of less than three vertices");
      IndexList list;
      for (std::size_t i = 0; i + 2 < count; ++i) {
        const std::size_t odd = i % 2;  // every second triangle of a strip runs the other way round
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
          list.indices.insert(list.indices.end(), {v[i], v[i + 1 + odd], v[i + 2 - odd]});
        else
          list.indices.insert(list.indices.end(), {v[i + 1], v[i + 2], v[0]});
      }
      return list;
    }
    default:
      return file.fail("a mesh has a mode that glTF does not know: " + std::to_string(mode));
  }
}

Result<IndexList> readIndexList(const GltfFile& file, const tinygltf::Primitive& primitive,
                                std::size_t vertexCount) {
  std::vector<std::uint32_t> indices;
  if (primitive.indices >= 0) {
    WEFT_TRY(indices, readIndices(file, primitive.indices));
  } else {
    WEFT_TRY_VOID(file.checkMemory(vertexCount * sizeof(std::uint32_t), "a mesh"));
    indices.resize(vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  for (const std::uint32_t index : indices)
    if (index >= vertexCount)
      return file.fail("a mesh has index " + std::to_string(index) + ", but only " +
                       std::to_string(vertexCount) + " vertices");
  return asList(file, primitive.mode, indices);
}

/// Leaves out the vertices that no index names, and numbers the others anew, in their order.
Result<ElementChoice> chooseUsed(const GltfFile& file, std::vector<std::uint32_t>& indices,
                                 std::size_t vertexCount) {
  const auto [first, last] = std::minmax_element(indices.begin(), indices.end());
  const std::uint32_t offset = *first;
  const std::size_t span = std::size_t{*last} - offset + 1;
  WEFT_TRY_VOID(file.checkMemory(span * sizeof(std::uint32_t), "a mesh"));
  std::vector<std::uint32_t> numbers(span, 0);  // 0: unused
  for (const std::uint32_t index : indices) numbers[index - offset] = 1;
  std::vector<std::uint32_t> used;
  for (std::uint32_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] != 0) {
      numbers[i] = static_cast<std::uint32_t>(used.size());
      used.push_back(i + offset);
    }
  if (used.size() == vertexCount) return ElementChoice();
  for (std::uint32_t& index : indices) index = numbers[index - offset];
  return ElementChoice(std::move(used));
}

/// What a mesh will take at most, normals and tangents that are generated included.
std::size_t memoryOf(const tinygltf::Primitive& primitive, const IndexList& list, const Vertices& vertices) {
  const bool isFlat = list.topology == Topology::Triangles && !primitive.attributes.contains("NORMAL");
  std::size_t each = sizeof(glm::vec3) * 2 + sizeof(glm::vec4) + sizeof(glm::vec2) * 2;
  if (primitive.attributes.contains("COLOR_0")) each += sizeof(glm::vec4);
  return (isFlat ? list.indices.size() : vertices.count()) * each +
         list.indices.size() * sizeof(std::uint32_t);
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

/// Moves the first set of texture coordinates as the placement says, and turns the tangents with
/// it.
void place(Mesh& mesh, const TexturePlacement& placement) {
  const glm::mat2 matrix = placement.matrix(), frame = placement.tangentFrame();
  for (glm::vec2& uv : mesh.texcoords) uv = matrix * uv + placement.offset;
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    const glm::vec3 tangent(mesh.tangents[i]);
    const glm::vec3 bitangent = mesh.tangents[i].w * glm::cross(mesh.normals[i], tangent);
    mesh.tangents[i] = glm::vec4(frame[0].x * tangent + frame[0].y * bitangent,
                                 mesh.tangents[i].w * glm::determinant(frame));
  }
}

bool areFinite(const std::vector<glm::vec3>& positions) {
  return std::all_of(positions.begin(), positions.end(), [](glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
}

Result<void> readTexcoords(const GltfFile& file, const tinygltf::Primitive& primitive, const MeshDress& dress,
                           const Vertices& vertices, std::vector<std::string>& warnings, Mesh& mesh) {
  const auto nameOf = [&](std::size_t which) { return "TEXCOORD_" + std::to_string(dress.sets[which]); };
  WEFT_TRY(mesh.texcoords, readAttribute<glm::vec2>(file, primitive.attributes, nameOf(0), vertices));
  WEFT_TRY(mesh.texcoords1, readAttribute<glm::vec2>(file, primitive.attributes, nameOf(1), vertices));
  if (mesh.texcoords.empty() && dress.usesTexcoords)
    warnings.push_back("a mesh has no " + nameOf(0) + ": it shows a single texel");
  if (mesh.texcoords.empty() && mesh.tangents.empty() && dress.usesTangents)
    warnings.push_back("a mesh has neither TANGENT nor " + nameOf(0) +
                       ": its highlights are stretched along a guessed direction");
  mesh.texcoords.resize(vertices.count(), glm::vec2(0));
  return {};
}

/// Completes what the shaders need and the file leaves out, or has for another set of texture
/// coordinates.
void complete(Mesh& mesh) {
  if (mesh.topology == Topology::Triangles) {
    if (mesh.normals.empty()) generateNormals(mesh, NormalKind::Flat);
    normalize(mesh.normals);
    if (mesh.tangents.empty() || !normalize(mesh.tangents)) generateTangents(mesh);
  } else {
    // Lines and points have no surface: they are shown without what these would be for.
    mesh.normals.resize(mesh.positions.size(), {0, 0, 1});
    normalize(mesh.normals);
    if (mesh.tangents.empty() || !normalize(mesh.tangents))
      mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, 1});
  }
}

Shading shadingOf(const tinygltf::Primitive& primitive) {
  const bool hasSurface = primitive.mode == -1 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
  if (hasSurface) return Shading::Full;
  if (!primitive.attributes.contains("NORMAL")) return Shading::Unlit;
  return primitive.attributes.contains("TANGENT") ? Shading::Full : Shading::WithoutTangents;
}

}  // namespace

Wearer wearerOf(const GltfFile& file, const tinygltf::Primitive& primitive) {
  Wearer wearer{.shading = shadingOf(primitive)};
  const auto colors = primitive.attributes.find("COLOR_0");
  // An accessor that does not exist is told where it is read.
  if (colors != primitive.attributes.end() && colors->second >= 0 &&
      static_cast<std::size_t>(colors->second) < file.model.accessors.size())
    wearer.hasAlpha =
        file.model.accessors[static_cast<std::size_t>(colors->second)].type == TINYGLTF_TYPE_VEC4;
  return wearer;
}

std::string meshKey(const tinygltf::Primitive& primitive, const MeshDress& dress, const MeshPose& pose) {
  const TexturePlacement& placement = dress.placement;
  std::string key =
      fmt::format("{} {} | {} {} {} | {} {} {} {} {} |", primitive.mode, primitive.indices, dress.sets[0],
                  dress.sets[1], dress.tangentSet, placement.scale.x, placement.scale.y, placement.rotation,
                  placement.offset.x, placement.offset.y);
  const auto append = [&](const Attributes& attributes) {
    for (const auto& [name, accessor] : attributes) key += fmt::format(" {} {}", name, accessor);
  };
  append(primitive.attributes);
  for (std::size_t i = 0; i < std::min(pose.morphWeights.size(), primitive.targets.size()); ++i) {
    if (pose.morphWeights[i] == 0.0f) continue;
    key += fmt::format(" | {}", pose.morphWeights[i]);
    append(primitive.targets[i]);
  }
  return key;
}

Result<std::shared_ptr<const Mesh>> readMesh(const GltfFile& file, const tinygltf::Primitive& primitive,
                                             const MeshDress& dress, const MeshPose& pose, std::size_t& taken,
                                             std::vector<std::string>& warnings) {
  const Attributes& attributes = primitive.attributes;
  Vertices vertices;
  WEFT_TRY(vertices.listed, countOf(file, attributes.at("POSITION")));
  WEFT_TRY(IndexList list, readIndexList(file, primitive, vertices.listed));
  WEFT_TRY(vertices.used, chooseUsed(file, list.indices, vertices.listed));
  taken += memoryOf(primitive, list, vertices);
  WEFT_TRY_VOID(file.checkMemory(taken, "the meshes"));

  Mesh mesh;
  mesh.topology = list.topology;
  mesh.indices = std::move(list.indices);
  WEFT_TRY(mesh.positions, readAttribute<glm::vec3>(file, attributes, "POSITION", vertices));
  WEFT_TRY(mesh.normals, readAttribute<glm::vec3>(file, attributes, "NORMAL", vertices));
  // glTF: without normals, tangents mean nothing.
  if (!mesh.normals.empty() && dress.sets[0] == dress.tangentSet) {
    WEFT_TRY(mesh.tangents, readAttribute<glm::vec4>(file, attributes, "TANGENT", vertices));
  }
  WEFT_TRY_VOID(readTexcoords(file, primitive, dress, vertices, warnings, mesh));
  WEFT_TRY(mesh.colors, readColors(file, attributes, vertices));

  WEFT_TRY_VOID(morph(file, primitive, "POSITION", pose.morphWeights, vertices, mesh.positions));
  WEFT_TRY_VOID(morph(file, primitive, "NORMAL", pose.morphWeights, vertices, mesh.normals));
  WEFT_TRY_VOID(morph(file, primitive, "TANGENT", pose.morphWeights, vertices, mesh.tangents));
  if (!pose.joints.empty() && attributes.contains("JOINTS_0")) {
    WEFT_TRY(const std::vector<glm::mat4> matrices, skinMatrices(file, attributes, pose.joints, vertices));
    skin(mesh, matrices);
  }
  if (!areFinite(mesh.positions)) return file.fail("the pose of a mesh is not finite");
  if (!mesh.normals.empty()) normalize(mesh.normals);
  place(mesh, dress.placement);
  complete(mesh);
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace weft
