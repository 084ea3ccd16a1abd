#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace weft {

/// What a mesh's indices join: triples to triangles, pairs to lines, or each one a point. Lines and
/// points are a pixel wide and have no back.
enum class Topology { Triangles, Lines, Points };

/// How many indices make one of them.
constexpr std::size_t verticesPer(Topology topology) {
  return topology == Topology::Triangles ? 3 : topology == Topology::Lines ? 2 : 1;
}

/// Indexed triangles (or lines, or points), counter-clockwise seen from the front, in glTF's
/// conventions: V runs down the image, and the bitangent, which points *up* the image, is tangent.w
/// (N x T).
///
/// Attribute lists are as long as `positions`; generateNormals() and generateTangents() fill what a
/// file leaves out.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   ///< unit
  std::vector<glm::vec4> tangents;  ///< xyz unit and along +U, w = +1 or -1
  std::vector<glm::vec2> texcoords;
  /// a second set, for the textures that ask for it; empty: zeros
  std::vector<glm::vec2> texcoords1;
  /// linear RGB and alpha, which PBRMaterial multiplies; empty: white
  std::vector<glm::vec4> colors;
  std::vector<std::uint32_t> indices;
  Topology topology = Topology::Triangles;
};

}  // namespace weft
