#include "weft/scenegraph/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {
namespace {

struct Triangle {
  glm::vec3 position[3];
  glm::vec3 normal[3];
};

template <class Visit>
void forEachTriangle(const Mesh& mesh, Visit visit) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.position[k] = mesh.positions[mesh.indices[i + k]];
      triangle.normal[k] = mesh.normals[mesh.indices[i + k]];
    }
    visit(triangle);
  }
}

void expectWellFormed(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  ASSERT_EQ(mesh.texcoords.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 tangent(mesh.tangents[i]);
    ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5f) << i;
    ASSERT_NEAR(glm::length(tangent), 1.0f, 1e-5f) << i;
    ASSERT_NEAR(glm::dot(tangent, mesh.normals[i]), 0.0f, 1e-5f) << i;
    ASSERT_EQ(std::abs(mesh.tangents[i].w), 1.0f) << i;
  }
  // Counter-clockwise from the front: the triangle's own normal is on the side of its vertices'
  // normals.
  forEachTriangle(mesh, [](const Triangle& t) {
    const glm::vec3 normal = glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]);
    ASSERT_GE(glm::dot(normal, t.normal[0] + t.normal[1] + t.normal[2]), -1e-9f);
  });
}

TEST(Shapes, ThePlanesTangentFrameIsTheCoordinateFrame) {
  const Mesh mesh = makePlane(3);
  expectWellFormed(mesh);
  EXPECT_EQ(mesh.indices.size(), 3u * 2 * 9);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    // V runs down the image, y up.
    EXPECT_NEAR(mesh.positions[i].x, mesh.texcoords[i].x - 0.5f, 1e-6f);
    EXPECT_NEAR(mesh.positions[i].y, 0.5f - mesh.texcoords[i].y, 1e-6f);
    EXPECT_EQ(mesh.positions[i].z, 0.0f);
    EXPECT_EQ(mesh.normals[i], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.tangents[i], glm::vec4(1, 0, 0, 1));
  }
}

TEST(Shapes, TheSpheresFrameLooksEastAndNorth) {
  const Mesh mesh = makeSphere(16);
  expectWellFormed(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(mesh.positions[i]), 1.0f, 1e-5f);
    const glm::vec3 normal = mesh.normals[i];
    EXPECT_LT(glm::distance(normal, mesh.positions[i]), 1e-6f);
    if (std::abs(normal.y) > 0.9999f) continue;
    const glm::vec3 east = glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
    EXPECT_LT(glm::distance(glm::vec3(mesh.tangents[i]), east), 1e-5f);
    const glm::vec3 bitangent = mesh.tangents[i].w * glm::cross(normal, glm::vec3(mesh.tangents[i]));
    EXPECT_GT(bitangent.y, 0.0f) << "up the image is north";
    EXPECT_NEAR(normal.y, std::cos(3.14159265f * mesh.texcoords[i].y), 1e-5f);
  }
}

float distanceFromSupport(glm::vec3 point) {
  return std::min(glm::length(point) - 0.6f, point.y + 0.6f);
}

TEST(Shapes, TheClothLiesOnItsSupportAndNeverInIt) {
  const Mesh mesh = makeDrapedCloth();
  expectWellFormed(mesh);
  float nearest = 1.0f;
  forEachTriangle(mesh, [&](const Triangle& t) {
    const glm::vec3 inside = (t.position[0] + t.position[1] + t.position[2]) / 3.0f;
    for (const glm::vec3 point : {t.position[0], t.position[1], t.position[2], inside})
      nearest = std::min(nearest, distanceFromSupport(point));
  });
  EXPECT_GT(nearest, 0.0f);
  EXPECT_LT(nearest, 0.02f);
  // It came to rest on top of the ball and hangs down to the floor.
  float lowest = 1.0f, highest = -1.0f;
  for (const glm::vec3 point : mesh.positions) {
    lowest = std::min(lowest, point.y);
    highest = std::max(highest, point.y);
  }
  EXPECT_NEAR(highest, 0.61f, 0.01f);
  EXPECT_NEAR(lowest, -0.59f, 0.01f);
}

TEST(Shapes, TheImageOnTheClothIsHardlyStretched) {
  const Mesh mesh = makeDrapedCloth();
  std::vector<float> stretches;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
      const glm::vec2 uv = mesh.texcoords[b] - mesh.texcoords[a];
      if (uv.x != 0.0f && uv.y != 0.0f) continue;  // diagonals shear, as cloth does
      stretches.push_back(glm::distance(mesh.positions[a], mesh.positions[b]) / (3.0f * glm::length(uv)));
    }
  std::sort(stretches.begin(), stretches.end());
  EXPECT_NEAR(stretches[stretches.size() / 2], 1.0f, 0.02f);
  EXPECT_GT(stretches[stretches.size() / 100], 0.85f);
  EXPECT_LT(stretches[stretches.size() - 1 - stretches.size() / 100], 1.15f);
}

TEST(Shapes, TheClothFallsTheSameWayEachTime) {
  EXPECT_EQ(makeDrapedCloth().positions, makeDrapedCloth().positions);
}

}  // namespace
}  // namespace weft
