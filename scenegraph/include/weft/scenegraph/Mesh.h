#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace weft {

/// Indexed triangles, counter-clockwise seen from the front, in glTF's conventions: V runs down the image,
/// and the bitangent, which points *up* the image, is tangent.w (N x T).
///
/// All attribute lists are as long as `positions`; generateNormals() and generateTangents() fill what a file
/// leaves out.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   ///< unit
  std::vector<glm::vec4> tangents;  ///< xyz unit and along +U, w = +1 or -1
  std::vector<glm::vec2> texcoords;
  std::vector<std::uint32_t> indices;  ///< three a triangle
};

}  // namespace weft
