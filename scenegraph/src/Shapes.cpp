#include "weft/scenegraph/Shapes.h"

#include <cmath>
#include <cstdint>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>

#include "Cloth.h"
#include "weft/core/Contract.h"
#include "weft/scenegraph/Tangents.h"

namespace weft {
namespace {

/// Two triangles for each cell of a grid of vertices in rows, where rows run down and columns to
/// the right as seen from the front.
std::vector<std::uint32_t> gridIndices(int columns, int rows) {
  std::vector<std::uint32_t> indices;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto upperLeft = static_cast<std::uint32_t>(row * (columns + 1) + column);
      const std::uint32_t upperRight = upperLeft + 1;
      const std::uint32_t lowerLeft = upperLeft + static_cast<std::uint32_t>(columns) + 1;
      const std::uint32_t lowerRight = lowerLeft + 1;
      for (const std::uint32_t index : {upperLeft, lowerLeft, lowerRight, upperLeft, lowerRight, upperRight})
        indices.push_back(index);
    }
  return indices;
}

std::vector<glm::vec2> gridTexcoords(int columns, int rows, glm::vec2 extent) {
  std::vector<glm::vec2> texcoords;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      texcoords.push_back(extent * glm::vec2(column, row) / glm::vec2(columns, rows));
  return texcoords;
}

}  // namespace

Mesh makePlane(int cells) {
  WEFT_EXPECT(cells > 0, "a plane has at least one cell");
  Mesh mesh;
  mesh.texcoords = gridTexcoords(cells, cells, {1, 1});
  mesh.indices = gridIndices(cells, cells);
  for (const glm::vec2 uv : mesh.texcoords) mesh.positions.emplace_back(uv.x - 0.5f, 0.5f - uv.y, 0.0f);
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, 1});
  return mesh;
}

Mesh makeSphere(int rings) {
  WEFT_EXPECT(rings > 1, "a sphere has at least two rings");
  Mesh mesh;
  mesh.texcoords = gridTexcoords(2 * rings, rings, {2, 1});
  mesh.indices = gridIndices(2 * rings, rings);
  for (const glm::vec2 uv : mesh.texcoords) {
    // The sine of a rounded pi is not 0, but the sphere is closed and its poles are points.
    const float longitude = uv.x == 2.0f ? 0.0f : glm::pi<float>() * uv.x;
    const float polar = glm::pi<float>() * uv.y;
    const float ring = uv.y == 0.0f || uv.y == 1.0f ? 0.0f : std::sin(polar);
    mesh.positions.emplace_back(-ring * std::sin(longitude), std::cos(polar), -ring * std::cos(longitude));
    mesh.tangents.emplace_back(-std::cos(longitude), 0.0f, std::sin(longitude), 1.0f);
  }
  mesh.normals = mesh.positions;
  return mesh;
}

Mesh makeDrapedCloth() {
  Mesh mesh;
  mesh.positions = dropCloth();
  const int cells = static_cast<int>(std::lround(std::sqrt(mesh.positions.size()))) - 1;
  mesh.texcoords = gridTexcoords(cells, cells, {1, 1});
  mesh.indices = gridIndices(cells, cells);
  generateNormals(mesh, NormalKind::Smooth);
  generateTangents(mesh);
  return mesh;
}

}  // namespace weft
