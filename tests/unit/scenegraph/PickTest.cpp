#include "weft/scenegraph/Pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "RandomTree.h"

namespace weft {
namespace {

using test::RandomTree;
using test::Shown;

/// Moeller and Trumbore's way, over every shown triangle, of one node alone or of all: the distance
/// to the nearest, infinity for none.
double nearestByForce(const Node& root, const Ray& ray, const Node* only = nullptr) {
  std::vector<Shown> shown;
  test::findShown(root, ray.origin, {}, shown);
  double nearest = std::numeric_limits<double>::infinity();
  const glm::dvec3 origin(ray.origin), direction = glm::normalize(glm::dvec3(ray.direction));
  for (const Shown& each : shown) {
    const auto* geometry = dynamic_cast<const Geometry*>(&each.node->core());
    if (!geometry || (only && only != each.node)) continue;
    const Mesh& mesh = *geometry->mesh();
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) {
        return glm::dvec3(each.toWorld * glm::dvec4(mesh.positions[mesh.indices[i + k]], 1.0));
      };
      const glm::dvec3 along = corner(1) - corner(0), across = corner(2) - corner(0);
      const glm::dvec3 p = glm::cross(direction, across);
      const double determinant = glm::dot(along, p);
      const glm::dvec3 offset = origin - corner(0);
      const double u = glm::dot(offset, p) / determinant;
      const glm::dvec3 q = glm::cross(offset, along);
      const double v = glm::dot(direction, q) / determinant;
      const double distance = glm::dot(across, q) / determinant;
      if (u >= 0 && v >= 0 && u + v <= 1 && distance >= 0 && distance < nearest) nearest = distance;
    }
  }
  return nearest;
}

/// From somewhere towards something.
Ray randomRay(RandomTree& tree) {
  const glm::vec3 eye = tree.point(8.0f);
  std::vector<Shown> shown;
  test::findShown(tree.root(), eye, {}, shown);
  if (shown.empty()) return {eye, tree.point(1.0f)};
  return {eye, glm::vec3(shown[tree.below(shown.size())].toWorld[3]) + tree.point(0.5f) - eye};
}

TEST(Pick, FindsWhatTestingEveryTriangleFinds) {
  int hits = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    RandomTree tree(seed);
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", ray " << i);
      const Ray ray = randomRay(tree);
      const double distance = nearestByForce(tree.root(), ray);
      const auto hit = pick(tree.root(), ray);
      ASSERT_EQ(hit.has_value(), std::isfinite(distance));
      if (!hit) continue;
      ++hits;
      EXPECT_NEAR(hit->distance, distance, 1e-4 * (1.0 + distance));
      // Two may lie in the same place.
      EXPECT_EQ(nearestByForce(tree.root(), ray, hit->path.back()), distance);
      EXPECT_EQ(hit->path.front(), &tree.root());
      for (std::size_t k = 1; k < hit->path.size(); ++k) EXPECT_EQ(hit->path[k]->parent(), hit->path[k - 1]);
      const glm::dvec3 position = ray.origin + glm::normalize(ray.direction) * hit->distance;
      EXPECT_LT(glm::distance(hit->position, position), 1e-4 * (1.0 + hit->distance));
      tree.change();
    }
  }
  EXPECT_GT(hits, 50) << "the test tests something";
}

std::shared_ptr<Geometry> plane() {
  return std::make_shared<Geometry>(std::make_shared<Mesh>(makePlane(3)));
}

std::shared_ptr<Transform> moved(glm::vec3 by) {
  return std::make_shared<Transform>(glm::translate(glm::mat4(1), by));
}

TEST(Pick, TellsTextureCoordinatesDistanceAndTheWayThere) {
  const auto shared = plane();
  Node root;
  const auto left = root.addChild(moved({-2, 0, 0}), "left");
  const auto right = root.addChild(
      std::make_shared<Transform>(glm::scale(glm::translate(glm::mat4(1), {2, 0, -3}), glm::vec3(4))),
      "right");
  left->addChild(shared);
  const auto instance = right->addChild(shared);
  const auto hit = pick(root, {{1, 1.5f, 7}, {0, 0, -2}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->path, (std::vector<const Node*>{&root, right.get(), instance.get()}));
  EXPECT_DOUBLE_EQ(hit->distance, 10.0);
  EXPECT_EQ(hit->position, glm::dvec3(1, 1.5, -3));
  // (1, 1.5) lies at (-0.25, 0.375) of the plane; v runs down.
  EXPECT_NEAR(hit->texcoord.x, 0.25f, 1e-6f);
  EXPECT_NEAR(hit->texcoord.y, 0.125f, 1e-6f);
}

TEST(Pick, MeetsBothSidesButNothingBehindTheOrigin) {
  Node root(plane());
  EXPECT_TRUE(pick(root, {{0.1f, 0.1f, -1}, {0, 0, 1}}));
  EXPECT_FALSE(pick(root, {{0.1f, 0.1f, 1}, {0, 0, 1}}));
  EXPECT_FALSE(pick(root, {{0.1f, 0.1f, 1}, {0, 1, 0}}));
  EXPECT_FALSE(pick(Node(), {}));
}

TEST(Pick, MeetsWhatIsFlattened) {
  Node root(std::make_shared<Transform>(glm::scale(glm::mat4(1), glm::vec3(1, 1, 0))));
  root.addChild(std::make_shared<Geometry>(std::make_shared<Mesh>(makeSphere(8))));
  EXPECT_TRUE(pick(root, {{0.3f, 0.2f, 1}, {0, 0, -1}}));
}

TEST(Pick, NoRaySlipsThroughAnEdge) {
  const auto sphere = std::make_shared<Mesh>(makeSphere(12));
  Node root(std::make_shared<Transform>(glm::rotate(glm::mat4(1), 0.7f, glm::vec3(1, 2, 3))));
  root.addChild(std::make_shared<Geometry>(sphere));
  const auto toWorld = glm::mat3(static_cast<const Transform&>(root.core()).matrix());
  RandomTree random(1);
  for (std::size_t i = 0; i < sphere->indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 a = sphere->positions[sphere->indices[i + k]];
      const glm::vec3 b = sphere->positions[sphere->indices[i + (k + 1) % 3]];
      const glm::vec3 inside = 0.2f * random.point(1.0f);
      for (const float place : {0.0f, 0.5f, random.between(0, 1)})
        EXPECT_TRUE(pick(root, {inside, toWorld * glm::mix(a, b, place) - inside}));
    }
}

TEST(Pick, SeesWhatSwitchesAndLevelsOfDetailShow) {
  Node root;
  const auto choice = std::make_shared<Switch>(0);
  const auto chosen = root.addChild(choice);
  const auto near = chosen->addChild(moved({0, 0, 2}));
  near->addChild(plane());
  const auto levels = chosen->addChild(std::make_shared<LOD>(std::vector<float>{5.0f}));
  levels->addChild(plane(), "fine");
  levels->addChild(moved({0, 0, -1}), "coarse")->addChild(plane());
  const auto distance = [&](float z) {
    const auto hit = pick(root, {{0.1f, 0.2f, z}, {0, 0, -1}});
    return hit ? hit->distance : -1.0;
  };
  EXPECT_DOUBLE_EQ(distance(4), 2.0);
  choice->setChoice(1);
  EXPECT_DOUBLE_EQ(distance(4), 4.0);
  EXPECT_DOUBLE_EQ(distance(6), 7.0);
  choice->setChoice(Switch::kNone);
  EXPECT_DOUBLE_EQ(distance(6), -1.0);
}

TEST(Pick, FindsPlacesAndLevelsFarFromTheOriginAndOfAnySize) {
  for (const double scale : {1e-9, 1.0, 1e9})
    for (const glm::dvec3 place :
         {glm::dvec3(0), scale * glm::dvec3(6.4e6, 1e6, -6.4e6), scale * glm::dvec3(1e9)}) {
      Node root(
          std::make_shared<Transform>(glm::scale(glm::translate(glm::dmat4(1), place), glm::dvec3(scale))));
      const auto levels =
          root.addChild(std::make_shared<LOD>(std::vector<float>{static_cast<float>(5.0 * scale)}));
      levels->addChild(plane(), "near");
      levels->addChild(plane(), "far");
      for (const double height : {4.999, 5.001}) {
        Camera camera = Camera::lookAt(place + scale * glm::dvec3(0, 0, height), place);
        camera.nearPlane = static_cast<float>(0.1 * scale);
        camera.farPlane = static_cast<float>(10.0 * scale);
        const auto hit = pick(root, Ray::through(camera, {0.55f, 0.45f}, 1.0f));
        ASSERT_TRUE(hit);
        const double side = 0.1 * height * std::tan(0.35);
        EXPECT_LT(glm::distance(hit->position, place + scale * glm::dvec3(side, side, 0)),
                  2e-6 * scale + 1e-12);
        EXPECT_NEAR(hit->texcoord.x, 0.5 + side, 1e-5);
        // The ray starts at the near plane.
        EXPECT_EQ(hit->path.back()->name(), "near") << height;
        camera.nearPlane = static_cast<float>(1e-4 * scale);
        const auto farther = pick(root, Ray::through(camera, {0.5f, 0.5f}, 1.0f));
        ASSERT_TRUE(farther);
        EXPECT_EQ(farther->path.back()->name(), height < 5.0 ? "near" : "far");
      }
    }
}

TEST(Pick, RaysOfACameraGoThroughTheirPixels) {
  Camera camera = Camera::lookAt({1, 2, 5}, {0, 0, 0});
  for (const float height : {0.0f, 3.0f}) {
    camera.orthographicHeight = height;
    for (const glm::vec2 place : {glm::vec2(0.5f, 0.5f), glm::vec2(0, 0), glm::vec2(0.9f, 0.2f)}) {
      const Ray ray = Ray::through(camera, place, 1.5f);
      const glm::dvec4 clip =
          camera.projection(1.5f) * camera.view * glm::dvec4(ray.origin + 3.0 * ray.direction, 1);
      EXPECT_NEAR(clip.x / clip.w, 2 * place.x - 1, 1e-4);
      EXPECT_NEAR(clip.y / clip.w, 1 - 2 * place.y, 1e-4);
    }
  }
}

}  // namespace
}  // namespace weft
