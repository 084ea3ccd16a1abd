#include "weft/baking/ReferenceRenderer.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "TestSupport.h"

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
using Kind = ReferenceLight::Kind;

// A square of side 2 in the plane z = 0. The columns of the image run along `right`, its rows
// against `up`.
ReferenceMesh square(glm::vec3 right = {1, 0, 0}, glm::vec3 up = {0, 1, 0}) {
  ReferenceMesh mesh;
  for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
    const glm::vec3 position(corner, 0.0f);
    mesh.positions.push_back(position);
    mesh.normals.emplace_back(0, 0, 1);
    mesh.tangents.emplace_back(right, glm::cross(right, up).z);
    mesh.texcoords.emplace_back(0.5f + 0.5f * glm::dot(position, right),
                                0.5f - 0.5f * glm::dot(position, up));
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

ReferenceMesh sphere(int rings) {
  ReferenceMesh mesh;
  const int columns = 2 * rings;
  for (int row = 0; row <= rings; ++row)
    for (int column = 0; column <= columns; ++column) {
      const glm::vec2 uv = glm::vec2(column, row) / glm::vec2(columns, rings);
      const float ring = std::sin(kPi * uv.y);
      const float longitude = 2.0f * kPi * uv.x;
      mesh.positions.emplace_back(ring * std::sin(longitude), std::cos(kPi * uv.y),
                                  ring * std::cos(longitude));
      mesh.tangents.emplace_back(std::cos(longitude), 0.0f, -std::sin(longitude), 1.0f);
      mesh.texcoords.push_back(uv);
    }
  mesh.normals = mesh.positions;
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rings); ++row)
    for (std::uint32_t column = 0; column + 1 < stride; ++column) {
      const std::uint32_t corner = row * stride + column;
      for (const std::uint32_t index :
           {corner, corner + stride, corner + stride + 1, corner, corner + stride + 1, corner + 1})
        mesh.indices.push_back(index);
    }
  return mesh;
}

ReferenceMaterial lambertian(glm::vec3 albedo) {
  return {.value = [albedo](int, int, glm::vec3 light, glm::vec3) { return light.z * albedo; }};
}

FloatImage rendered(ReferenceMesh mesh, const ReferenceShot& shot, const ReferenceMaterial& material) {
  return test::valueOf(ReferenceRenderer::create(std::move(mesh))).render(shot, material);
}

glm::vec3 rgbAt(const FloatImage& image, int x, int y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

// The direction from (0, 0, 3) through the middle of a pixel, in a picture whose half height is 1
// at z = 0.
glm::vec3 rayThrough(const ReferenceShot& shot, int x, int y) {
  const glm::vec2 place = (glm::vec2(x, y) + 0.5f) / glm::vec2(shot.width, shot.height) * 2.0f - 1.0f;
  const float aspect = static_cast<float>(shot.width) / static_cast<float>(shot.height);
  return glm::vec3(place.x * aspect, -place.y, -3.0f);
}

ReferenceShot frontShot(int width, int height, int samples = 1) {
  ReferenceShot shot;
  shot.verticalFieldOfView = 2.0f * std::atan(1.0f / 3.0f);
  shot.width = width;
  shot.height = height;
  shot.samples = samples;
  return shot;
}

TEST(ReferenceRenderer, LitPlanesAreAsComputedByHand) {
  ReferenceShot shot = frontShot(24, 16);
  const glm::vec3 place(0.5f, 0.3f, 1.2f);
  shot.lights = {{Kind::Point, place, glm::vec3(2, 3, 4)},
                 {Kind::Directional, glm::vec3(0.6f, 0, 0.8f) * 5.0f, glm::vec3(1, 0.5f, 0)},
                 {Kind::Directional, glm::vec3(0, 0, -1), glm::vec3(100)}};
  const glm::vec3 albedo(0.9f, 0.5f, 0.1f);
  const FloatImage image = rendered(square(), shot, lambertian(albedo));
  EXPECT_THAT(image.channels(), testing::ElementsAre("R", "G", "B", "A"));
  for (int y = 0; y < shot.height; ++y)
    for (int x = 0; x < shot.width; ++x) {
      const glm::vec3 point = shot.eye + rayThrough(shot, x, y);
      const bool hit = std::abs(point.x) < 1.0f;  // the picture is wider than the square
      EXPECT_EQ(image.at(x, y, 3), hit ? 1.0f : 0.0f);
      const glm::vec3 towards = place - point;
      const float squared = glm::dot(towards, towards);
      const float cosine = towards.z / std::sqrt(squared);
      const glm::vec3 irradiance = glm::vec3(2, 3, 4) / squared * cosine + glm::vec3(1, 0.5f, 0) * 0.8f;
      const glm::vec3 expected = hit ? albedo * irradiance / kPi : glm::vec3(0.0f);
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(image.at(x, y, channel), expected[channel], 1e-5f) << x << " " << y;
    }
}

TEST(ReferenceRenderer, TheSilhouetteOfASphereIsACircle) {
  ReferenceShot shot = frontShot(64, 64, 4);
  shot.verticalFieldOfView = 0.8f;
  const FloatImage image = rendered(sphere(256), shot, lambertian(glm::vec3(1)));
  double covered = 0.0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) covered += image.at(x, y, 3);
  const double radius = std::tan(std::asin(1.0 / 3.0)) / std::tan(0.4) * 32.0;  // pixels
  EXPECT_NEAR(covered / (std::numbers::pi * radius * radius), 1.0, 1e-3);
}

TEST(ReferenceRenderer, AWhiteSphereShadesAsItsNormalsSay) {
  ReferenceShot shot = frontShot(33, 33);
  const glm::vec3 toLight = glm::normalize(glm::vec3(1, 2, 2));
  shot.lights = {{Kind::Directional, toLight, glm::vec3(kPi)}};
  const FloatImage image = rendered(sphere(256), shot, lambertian(glm::vec3(1)));
  int lit = 0;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) {
      const glm::vec3 ray = glm::normalize(rayThrough(shot, x, y));
      const float along = glm::dot(ray, shot.eye);
      const float root = along * along - glm::dot(shot.eye, shot.eye) + 1.0f;
      if (root < 0.02f) continue;  // outside, or where the polyhedron's silhouette differs
      const glm::vec3 normal = shot.eye + (-along - std::sqrt(root)) * ray;
      const float cosine = glm::dot(normal, toLight);
      if (std::abs(cosine) < 0.02f) continue;  // facets shadow themselves here
      EXPECT_NEAR(image.at(x, y, 0), std::max(cosine, 0.0f), 2e-3f) << x << " " << y;
      lit += cosine > 0.0f;
    }
  EXPECT_GT(lit, 300);
}

TEST(ReferenceRenderer, TexelsAreThoseOfTheImageSeenFromTheFront) {
  ReferenceShot shot = frontShot(8, 8);
  shot.lights = {{Kind::Directional, {0, 0, 1}, glm::vec3(kPi)}};
  ReferenceMaterial material{.width = 2, .height = 2, .repetitions = glm::vec2(2.0f)};
  material.value = [](int x, int y, glm::vec3, glm::vec3) { return glm::vec3(x, y, 0); };
  const FloatImage image = rendered(square(), shot, material);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(rgbAt(image, x, y), glm::vec3(x / 2 % 2, y / 2 % 2, 0));
}

// A relief has a view and a light of its own at every texel: nothing of it is symmetric.
ReferenceMaterial relief(int width, int height) {
  ReferenceMaterial material{.width = width, .height = height};
  material.value = [](int x, int y, glm::vec3 light, glm::vec3 view) {
    return glm::vec3(1.0f + 0.3f * light.x + 0.2f * view.y, 0.2f * static_cast<float>(x) + 0.1f * view.x,
                     0.3f * static_cast<float>(y) + light.y);
  };
  return material;
}

TEST(ReferenceRenderer, MirroredAndTurnedTexturesShowTheRearrangedPicture) {
  ReferenceShot shot = frontShot(16, 16);
  const glm::vec3 toLight(0.3f, 0.5f, 0.8f);
  shot.lights = {{Kind::Directional, toLight, glm::vec3(kPi)}};
  const FloatImage upright = rendered(square(), shot, relief(4, 4));

  shot.lights[0].place = {-toLight.x, toLight.y, toLight.z};
  const FloatImage mirrored = rendered(square({-1, 0, 0}), shot, relief(4, 4));
  shot.lights[0].place = {-toLight.y, toLight.x, toLight.z};
  const FloatImage turned = rendered(square({0, 1, 0}, {-1, 0, 0}), shot, relief(4, 4));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(mirrored.at(15 - x, y, channel), upright.at(x, y, channel), 1e-5f);
        EXPECT_NEAR(turned.at(y, 15 - x, channel), upright.at(x, y, channel), 1e-5f);
      }
}

TEST(ReferenceRenderer, FromBehindTheImageIsMirroredAndLitFromThere) {
  ReferenceShot shot = frontShot(16, 16);
  shot.lights = {{Kind::Directional, {0.3f, 0.5f, 0.8f}, glm::vec3(kPi)}};
  const FloatImage front = rendered(square(), shot, relief(4, 4));
  shot.eye.z = -3.0f;
  const FloatImage dark = rendered(square(), shot, relief(4, 4));
  shot.lights[0].place.z = -0.8f;
  const FloatImage behind = rendered(square(), shot, relief(4, 4));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      EXPECT_EQ(rgbAt(dark, x, y), glm::vec3(0.0f));
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(behind.at(15 - x, y, channel), front.at(x, y, channel), 1e-5f);
    }
}

TEST(ReferenceRenderer, ShadowsFallWhereTheLightIsHidden) {
  // A second, smaller square at z = 1 stands between the light and the first.
  ReferenceMesh mesh = square();
  const ReferenceMesh small = square();
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.positions.push_back(0.25f * small.positions[i] + glm::vec3(0, 0, 1));
    mesh.normals.push_back(small.normals[i]);
    mesh.tangents.push_back(small.tangents[i]);
    mesh.texcoords.push_back(small.texcoords[i]);
  }
  mesh.indices.insert(mesh.indices.end(), {4, 5, 6, 4, 6, 7});
  ReferenceShot shot = frontShot(64, 64);
  const auto litAt = [&](float x) {
    const FloatImage image = rendered(mesh, shot, lambertian(glm::vec3(1)));
    return image.at(static_cast<int>(32.0f + 32.0f * x), 31, 0) > 0.0f;
  };
  shot.lights = {{Kind::Directional, {-0.6f, 0, 1}, glm::vec3(1)}};  // the shadow: 0.6 +- 0.25
  for (const auto& [x, lit] : {std::pair(0.45f, false), {0.75f, false}, {0.95f, true}, {-0.6f, true}})
    EXPECT_EQ(litAt(x), lit) << x;
  // from -0.6 through +-0.25: 0.6 +- 0.5
  shot.lights = {{Kind::Point, {-0.6f, 0, 2}, glm::vec3(1)}};
  for (const auto& [x, lit] : {std::pair(0.45f, false), {0.95f, false}, {-0.6f, true}})
    EXPECT_EQ(litAt(x), lit) << x;
  shot.lights[0].place.z = 0.5f;  // below the small square
  EXPECT_TRUE(litAt(0.95f));
  shot.lights[0].place.z = 2.0f;
  shot.shadows = false;
  EXPECT_TRUE(litAt(0.45f));
}

TEST(ReferenceRenderer, TheFoldedClothHasTheNormalsOfItsSurface) {
  const ReferenceMesh mesh = makeFoldedCloth();
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto [a, b, c] = std::array{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    const glm::vec3 facet = glm::normalize(
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
    ASSERT_GT(glm::dot(facet, mesh.normals[a]), 0.998f);
    ASSERT_NEAR(glm::dot(mesh.normals[a], glm::vec3(mesh.tangents[a])), 0.0f, 1e-5f);
  }
  EXPECT_LT(std::ranges::min_element(mesh.normals, {}, &glm::vec3::z)->z, 0.8f) << "there are folds";
}

TEST(ReferenceRenderer, PicturesDoNotDependOnThreads) {
  ReferenceShot shot;
  shot.width = shot.height = 48;
  shot.lights = {{Kind::Point, {1, 1, 2}, glm::vec3(5)}};
  const auto bytes = [&] {
    const FloatImage image = rendered(makeFoldedCloth(), shot, relief(7, 5));
    return std::vector<float>(image.values().begin(), image.values().end());
  };
  const std::vector<float> many = bytes();
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, bytes());
}

TEST(ReferenceRenderer, RefusesBrokenMeshes) {
  const auto messageFor = [](auto&& change) {
    ReferenceMesh mesh = square();
    change(mesh);
    const auto renderer = ReferenceRenderer::create(std::move(mesh));
    return renderer ? "accepted" : renderer.error().message();
  };
  EXPECT_THAT(messageFor([](ReferenceMesh& m) { m.normals.pop_back(); }), testing::HasSubstr("number"));
  EXPECT_THAT(messageFor([](ReferenceMesh& m) { m.indices.pop_back(); }), testing::HasSubstr("three"));
  EXPECT_THAT(messageFor([](ReferenceMesh& m) { m.indices.clear(); }), testing::HasSubstr("three"));
  EXPECT_THAT(messageFor([](ReferenceMesh& m) { m.indices[2] = 4; }), testing::HasSubstr("nowhere"));
  EXPECT_THAT(
      messageFor([](ReferenceMesh& m) { m.texcoords[1].x = std::numeric_limits<float>::quiet_NaN(); }),
      testing::HasSubstr("finite"));
}

}  // namespace
}  // namespace weft
