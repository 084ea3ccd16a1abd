#include "weft/scenegraph/Tangents.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <span>

#include "weft/core/Contract.h"

namespace weft {
namespace {

using Corners = std::array<std::uint32_t, 3>;

std::size_t triangleCount(const Mesh& mesh) {
  return mesh.indices.size() / 3;
}

Corners cornersOf(const Mesh& mesh, std::size_t triangle) {
  return {mesh.indices[3 * triangle], mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]};
}

glm::vec3 normalizedOr(glm::vec3 vector, glm::vec3 otherwise) {
  // Scaled first, so that the square of a tiny or huge vector does not leave the range of a float.
  const float scale = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
  return scale > 0.0f && std::isfinite(scale) ? glm::normalize(vector / scale) : otherwise;
}

float angleBetween(glm::vec3 a, glm::vec3 b) {
  return std::acos(std::clamp(glm::dot(normalizedOr(a, {}), normalizedOr(b, {})), -1.0f, 1.0f));
}

glm::vec3 faceNormal(const Mesh& mesh, const Corners& corner) {
  const glm::vec3 origin = mesh.positions[corner[0]];
  return normalizedOr(glm::cross(normalizedOr(mesh.positions[corner[1]] - origin, {}),
                                 normalizedOr(mesh.positions[corner[2]] - origin, {})),
                      {});
}

float cornerAngle(const Mesh& mesh, const Corners& corner, std::size_t k) {
  const glm::vec3 apex = mesh.positions[corner[k]];
  return angleBetween(mesh.positions[corner[(k + 1) % 3]] - apex, mesh.positions[corner[(k + 2) % 3]] - apex);
}

/// For every vertex the number of the first one whose `key` is the same.
template <class Key>
std::vector<std::uint32_t> firstEqual(std::size_t count, Key key) {
  std::map<decltype(key(0)), std::uint32_t> firsts;
  std::vector<std::uint32_t> first(count);
  for (std::size_t i = 0; i < count; ++i)
    first[i] = firsts.try_emplace(key(i), static_cast<std::uint32_t>(i)).first->second;
  return first;
}

/// Comparable, with the two zeros equal, and defined for every float.
std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0f);
}

void unshareVertices(Mesh& mesh) {
  const auto gather = [&](auto& attribute) {
    if (attribute.empty()) return;
    auto gathered = attribute;
    gathered.clear();
    gathered.reserve(mesh.indices.size());
    for (const std::uint32_t index : mesh.indices) gathered.push_back(attribute[index]);
    attribute = std::move(gathered);
  };
  gather(mesh.positions);
  gather(mesh.tangents);
  gather(mesh.texcoords);
  gather(mesh.texcoords1);
  gather(mesh.colors);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
}

/// A triangle's direction of +U, and whether its image is mirrored; +U is 0 where the image has no
/// area.
struct ImageAxes {
  glm::vec3 alongU{};
  bool mirrored = false;
};

ImageAxes imageAxes(const Mesh& mesh, const Corners& corner) {
  const glm::vec3 edge1 = mesh.positions[corner[1]] - mesh.positions[corner[0]];
  const glm::vec3 edge2 = mesh.positions[corner[2]] - mesh.positions[corner[0]];
  const glm::vec2 uv1 = mesh.texcoords[corner[1]] - mesh.texcoords[corner[0]];
  const glm::vec2 uv2 = mesh.texcoords[corner[2]] - mesh.texcoords[corner[0]];
  const float area = uv1.x * uv2.y - uv1.y * uv2.x;
  if (area == 0.0f || !std::isfinite(area)) return {};
  // Counter-clockwise triangles run clockwise in (u, v) because V runs down the image.
  const float sign = area < 0.0f ? -1.0f : 1.0f;
  return {normalizedOr(sign * (uv2.y * edge1 - uv1.y * edge2), {}), area > 0.0f};
}

glm::vec3 anyPerpendicular(glm::vec3 normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return normalizedOr(axis - glm::dot(axis, normal) * normal, {1, 0, 0});
}

/// The sums of +U at one vertex over the triangles whose image is not mirrored, and over those
/// where it is.
struct TangentSums {
  std::array<glm::vec3, 2> sum{};
  std::array<bool, 2> used{};
};

std::vector<TangentSums> sumTangents(const Mesh& mesh, std::span<const std::uint32_t> group) {
  std::vector<TangentSums> sums(mesh.positions.size());
  for (std::size_t triangle = 0; triangle < triangleCount(mesh); ++triangle) {
    const Corners corner = cornersOf(mesh, triangle);
    const ImageAxes axes = imageAxes(mesh, corner);
    if (axes.alongU == glm::vec3(0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 normal = mesh.normals[corner[k]];
      const glm::vec3 inPlane = axes.alongU - glm::dot(axes.alongU, normal) * normal;
      TangentSums& here = sums[group[corner[k]]];
      here.sum[axes.mirrored] += cornerAngle(mesh, corner, k) * normalizedOr(inPlane, {});
      here.used[axes.mirrored] = true;
    }
  }
  return sums;
}

void copyVertex(Mesh& mesh, std::uint32_t vertex) {
  mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
  mesh.normals.push_back(glm::vec3(mesh.normals[vertex]));
  mesh.texcoords.push_back(glm::vec2(mesh.texcoords[vertex]));
  if (!mesh.texcoords1.empty()) mesh.texcoords1.push_back(glm::vec2(mesh.texcoords1[vertex]));
  if (!mesh.colors.empty()) mesh.colors.push_back(glm::vec4(mesh.colors[vertex]));
}

}  // namespace

void generateNormals(Mesh& mesh, NormalKind kind) {
  WEFT_EXPECT(mesh.indices.size() % 3 == 0, "three indices a triangle");
  if (kind == NormalKind::Flat) unshareVertices(mesh);
  std::vector<std::uint32_t> group(mesh.positions.size());
  if (kind == NormalKind::Smooth) {
    group = firstEqual(mesh.positions.size(), [&](std::size_t i) {
      const glm::vec3 p = mesh.positions[i];
      return std::array{bits(p.x), bits(p.y), bits(p.z)};
    });
  } else {
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<std::uint32_t>(i);
  }

  std::vector<glm::vec3> sums(mesh.positions.size());
  for (std::size_t triangle = 0; triangle < triangleCount(mesh); ++triangle) {
    const Corners corner = cornersOf(mesh, triangle);
    const glm::vec3 normal = faceNormal(mesh, corner);
    for (std::size_t k = 0; k < 3; ++k)
      sums[group[corner[k]]] += (kind == NormalKind::Flat ? 1.0f : cornerAngle(mesh, corner, k)) * normal;
  }
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i < group.size(); ++i) mesh.normals[i] = normalizedOr(sums[group[i]], {0, 0, 1});
}

void generateTangents(Mesh& mesh) {
  WEFT_EXPECT(mesh.indices.size() % 3 == 0, "three indices a triangle");
  WEFT_EXPECT(mesh.normals.size() == mesh.positions.size() && mesh.texcoords.size() == mesh.positions.size(),
              "tangents need normals and texture coordinates");
  const std::vector<std::uint32_t> group = firstEqual(mesh.positions.size(), [&](std::size_t i) {
    const glm::vec3 p = mesh.positions[i], n = mesh.normals[i];
    const glm::vec2 t = mesh.texcoords[i];
    return std::array{bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y), bits(n.z), bits(t.x), bits(t.y)};
  });
  const std::vector<TangentSums> sums = sumTangents(mesh, group);

  const std::size_t original = mesh.positions.size();
  // Where both kinds of triangles meet at a vertex the mirrored ones get a copy of it.
  std::vector<std::uint32_t> mirroredCopy(original, 0);
  for (std::size_t triangle = 0; triangle < triangleCount(mesh); ++triangle) {
    if (!imageAxes(mesh, cornersOf(mesh, triangle)).mirrored) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& index = mesh.indices[3 * triangle + k];
      if (!sums[group[index]].used[0]) continue;
      if (mirroredCopy[index] == 0) {
        mirroredCopy[index] = static_cast<std::uint32_t>(mesh.positions.size());
        copyVertex(mesh, index);
      }
      index = mirroredCopy[index];
    }
  }

  mesh.tangents.resize(mesh.positions.size());
  const auto tangentOf = [&](std::size_t vertex, bool mirrored) {
    const glm::vec3 normal = mesh.normals[vertex];
    const glm::vec3 sum = sums[group[vertex]].sum[mirrored];
    const glm::vec3 tangent = normalizedOr(sum - glm::dot(sum, normal) * normal, anyPerpendicular(normal));
    return glm::vec4(tangent, mirrored ? -1.0f : 1.0f);
  };
  for (std::size_t i = 0; i < original; ++i) {
    const std::array<bool, 2>& used = sums[group[i]].used;
    mesh.tangents[i] = tangentOf(i, used[1] && !used[0]);
    if (mirroredCopy[i] != 0) mesh.tangents[mirroredCopy[i]] = tangentOf(i, true);
  }
}

}  // namespace weft
