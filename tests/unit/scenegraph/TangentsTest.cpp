#include "weft/scenegraph/Tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "weft/scenegraph/Shapes.h"

namespace weft {
namespace {

glm::vec3 xyz(glm::vec4 v) {
  return glm::vec3(v);
}

float worstTangent(const Mesh& actual, const Mesh& expected, float polesFrom = 2.0f) {
  float worst = 0.0f;
  for (std::size_t i = 0; i < expected.tangents.size(); ++i) {
    if (std::abs(expected.normals[i].y) > polesFrom) continue;
    worst = std::max(worst, glm::distance(actual.tangents[i], expected.tangents[i]));
  }
  return worst;
}

TEST(Tangents, OfAPlaneAreExact) {
  Mesh mesh = makePlane(4);
  generateTangents(mesh);
  EXPECT_LT(worstTangent(mesh, makePlane(4)), 1e-6f);
}

TEST(Tangents, OfASphereAreTheAnalyticOnes) {
  Mesh mesh = makeSphere(64);
  generateTangents(mesh);
  ASSERT_EQ(mesh.positions.size(), makeSphere(64).positions.size()) << "no vertex is split";
  // Where the image closes, u = 0 and u = 2 see half of their neighbours: half a cell, 180 / 128
  // degrees.
  EXPECT_LT(worstTangent(mesh, makeSphere(64), 0.95f), 0.0125f * 2.0f);
}

TEST(Tangents, FollowATurnedImage) {
  Mesh mesh = makePlane(2);
  // +U down, the image's up to the right
  for (glm::vec2& uv : mesh.texcoords) uv = {uv.y, 1.0f - uv.x};
  generateTangents(mesh);
  for (const glm::vec4 tangent : mesh.tangents) EXPECT_LT(glm::distance(tangent, {0, -1, 0, 1}), 1e-6f);
}

TEST(Tangents, OfAMirroredImageAreLeftHanded) {
  Mesh mesh = makePlane(2);
  for (glm::vec2& uv : mesh.texcoords) uv.x = 1.0f - uv.x;
  generateTangents(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_LT(glm::distance(mesh.tangents[i], {-1, 0, 0, -1}), 1e-6f);
    const glm::vec3 bitangent = mesh.tangents[i].w * glm::cross(mesh.normals[i], xyz(mesh.tangents[i]));
    EXPECT_LT(glm::distance(bitangent, {0, 1, 0}), 1e-6f) << "up the image stays up";
  }
}

TEST(Tangents, SplitVerticesWhereTheImageIsMirrored) {
  Mesh mesh = makePlane(2);  // the middle column is shared by both halves
  for (glm::vec2& uv : mesh.texcoords) uv.x = std::abs(uv.x - 0.5f);
  generateTangents(mesh);
  EXPECT_EQ(mesh.positions.size(), 9u + 3u);
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    float middle = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.indices[i + k]].x / 3.0f;
    const float side = middle < 0.0f ? -1.0f : 1.0f;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(glm::distance(mesh.tangents[mesh.indices[i + k]], {side, 0, 0, side}), 1e-6f);
  }
}

TEST(Tangents, AreValidWhereTheImageHasNoArea) {
  Mesh mesh = makeSphere(8);
  for (glm::vec2& uv : mesh.texcoords) uv = {0.25f, 0.75f};
  generateTangents(mesh);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(xyz(mesh.tangents[i])), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(xyz(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-5f);
    EXPECT_EQ(mesh.tangents[i].w, 1.0f);
  }
}

TEST(Tangents, DoNotDependOnHowAFileSplitsVertices) {
  Mesh shared = makeSphere(12);
  Mesh separate;
  for (const std::uint32_t index : shared.indices) {
    separate.indices.push_back(static_cast<std::uint32_t>(separate.indices.size()));
    separate.positions.push_back(shared.positions[index]);
    separate.normals.push_back(shared.normals[index]);
    separate.texcoords.push_back(shared.texcoords[index]);
  }
  generateTangents(shared);
  generateTangents(separate);
  for (std::size_t i = 0; i < shared.indices.size(); ++i)
    ASSERT_EQ(separate.tangents[i], shared.tangents[shared.indices[i]]) << i;
}

TEST(Normals, SmoothOnesOfASphereAreItsPositions) {
  Mesh mesh = makeSphere(48);
  generateNormals(mesh, NormalKind::Smooth);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    ASSERT_LT(glm::distance(mesh.normals[i], mesh.positions[i]), 1e-3f) << i;
}

TEST(Normals, FlatOnesAreThoseOfTheTriangles) {
  Mesh mesh = makeSphere(6);
  const Mesh original = mesh;
  generateNormals(mesh);
  ASSERT_EQ(mesh.positions.size(), original.indices.size());
  ASSERT_EQ(mesh.texcoords.size(), original.indices.size());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[i], b = mesh.positions[i + 1], c = mesh.positions[i + 2];
    EXPECT_EQ(a, original.positions[original.indices[i]]);
    EXPECT_EQ(mesh.normals[i], mesh.normals[i + 1]);
    EXPECT_EQ(mesh.normals[i], mesh.normals[i + 2]);
    if (glm::length(glm::cross(b - a, c - a)) < 1e-6f) continue;  // at the poles
    EXPECT_LT(glm::distance(mesh.normals[i], glm::normalize(glm::cross(b - a, c - a))), 1e-5f);
  }
}

TEST(Normals, OfTrianglesOfAnySizeAreUnit) {
  for (const float size : {1e-25f, 1e-6f, 1e25f}) {
    Mesh mesh = makePlane();
    for (glm::vec3& position : mesh.positions) position *= size;
    generateNormals(mesh, NormalKind::Smooth);
    for (const glm::vec3 normal : mesh.normals) EXPECT_LT(glm::distance(normal, {0, 0, 1}), 1e-6f) << size;
  }
}

}  // namespace
}  // namespace weft
