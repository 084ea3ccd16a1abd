#include "weft/scenegraph/Bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "RandomTree.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Switch.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

using test::RandomTree;

TEST(Bounds, EncloseTransformedGeometry) {
  const auto plane = std::make_shared<Geometry>(std::make_shared<Mesh>(makePlane()));
  Node root;
  const auto outer =
      root.addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1), glm::vec3(10, 0, 0))));
  const auto inner =
      outer->addChild(std::make_shared<Transform>(glm::scale(glm::mat4(1), glm::vec3(2, 4, 1))));
  inner->addChild(plane);
  root.addChild(plane);  // the same core twice
  const Bounds bounds = boundsOf(root);
  EXPECT_EQ(bounds.minimum, glm::dvec3(-0.5, -2.0, 0.0));
  EXPECT_EQ(bounds.maximum, glm::dvec3(11.0, 2.0, 0.0));
  EXPECT_EQ(bounds.center(), glm::dvec3(5.25, 0.0, 0.0));
}

TEST(Bounds, OfNothingAreEmpty) {
  EXPECT_TRUE(boundsOf(Node()).empty());
  EXPECT_EQ(boundsOf(Node()).radius(), 0.0);
}

TEST(Frame, ShowsAllVerticesAndFillsThePicture) {
  Node root;
  root.addChild(std::make_shared<Transform>(
                    glm::scale(glm::translate(glm::mat4(1), glm::vec3(1, 2, 5)), glm::vec3(2, 0.5f, 1))))
      ->addChild(std::make_shared<Geometry>(std::make_shared<Mesh>(makeSphere())));
  for (const float aspect : {0.5f, 1.0f, 2.0f})
    for (const glm::vec3 from : {glm::vec3(0, 0, 1), glm::vec3(0, 5, 0), glm::vec3(-1, 0.3f, 0.7f)}) {
      const Camera camera = frame(root, from, aspect);
      const glm::mat4 toClip = camera.projection(aspect) * camera.view;
      glm::vec3 low(2), high(-2);
      for (const glm::vec3 position : makeSphere().positions) {
        const glm::vec4 clip =
            toClip * glm::vec4(glm::vec3(1, 2, 5) + glm::vec3(2, 0.5f, 1) * position, 1.0f);
        ASSERT_GT(clip.w, 0.0f);
        low = glm::min(low, glm::vec3(clip) / clip.w);
        high = glm::max(high, glm::vec3(clip) / clip.w);
      }
      EXPECT_GT(low.z, -1.0f);
      EXPECT_LT(high.z, 1.0f);
      // Both sides of the wider direction touch the margin, the other lies within it.
      EXPECT_NEAR(std::max(high.x, high.y), 1.0f / 1.06f, 1e-4f);
      EXPECT_NEAR(std::min(low.x, low.y), -1.0f / 1.06f, 1e-4f);
      EXPECT_GT(glm::dot(camera.position() - glm::dvec3(1, 2, 5), glm::dvec3(from)), 0.0);
    }
}

TEST(Bounds, AreThoseOfWhatIsSeen) {
  const auto plane = std::make_shared<Geometry>(std::make_shared<Mesh>(makePlane()));
  const auto choice = std::make_shared<Switch>(0);
  const auto at = [](glm::dvec3 place, glm::dvec3 scale) {
    return std::make_shared<Transform>(glm::scale(glm::translate(glm::dmat4(1), place), scale));
  };
  Node root(choice);
  const auto shown = root.addChild(std::make_shared<Group>());
  shown->addChild(plane);
  shown->addChild(at({50, 0, 0}, glm::dvec3(0)))->addChild(plane);
  shown->addChild(at({0, 50, 0}, {0, 1, 0}))->addChild(plane);
  root.addChild(at({0, 0, 50}, glm::dvec3(1)))->addChild(plane);
  const auto extent = [&] { return boundsOf(root).maximum; };
  EXPECT_EQ(extent(), glm::dvec3(0.5, 0.5, 0.0)) << "not of what a scale of 0 or a switch hides";
  choice->setChoice(1);
  EXPECT_EQ(boundsOf(root).minimum, glm::dvec3(-0.5, -0.5, 50.0));
  choice->setChoice(Switch::kAll);
  EXPECT_EQ(extent(), glm::dvec3(0.5, 0.5, 50.0));
  choice->setChoice(Switch::kNone);
  EXPECT_TRUE(boundsOf(root).empty());
  EXPECT_EQ(boundsOf(*shown).maximum, glm::dvec3(0.5, 0.5, 0.0)) << "a branch is looked at for itself";
}

TEST(Bounds, HeedFlattenedSurfacesAndLinesButNoLeftOverVertices) {
  auto mesh = std::make_shared<Mesh>(makePlane());
  mesh->positions.emplace_back(100, 100, 100);
  mesh->positions.emplace_back(0, 100, 0);
  mesh->indices.insert(mesh->indices.end(), {5, 5, 5, 0, 5, 0});  // skins hide parts so
  Node flat(std::make_shared<Transform>(glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0))));
  flat.addChild(std::make_shared<Geometry>(mesh));
  EXPECT_EQ(boundsOf(flat).maximum, glm::dvec3(0.5, 0.5, 0.0));
  auto lines = std::make_shared<Mesh>();
  lines->positions = {{0, 0, 0}, {3, 4, 5}};
  lines->indices = {0, 1};
  lines->topology = Topology::Lines;
  Node narrow(std::make_shared<Transform>(glm::scale(glm::dmat4(1), glm::dvec3(1, 0, 0))));
  narrow.addChild(std::make_shared<Geometry>(lines));
  EXPECT_EQ(boundsOf(narrow).maximum, glm::dvec3(3, 0, 0));
}

TEST(Bounds, TellHowNearAMeshComesToAPoint) {
  RandomTree random(5);
  for (int round = 0; round < 200; ++round) {
    const auto mesh = std::make_shared<Mesh>();
    mesh->positions = {random.point(2), random.point(2), random.point(2)};
    mesh->indices = {0, 1, 2};
    const glm::dvec3 point = random.point(3);
    double nearest = std::numeric_limits<double>::infinity();
    constexpr int steps = 100;
    for (int i = 0; i <= steps; ++i)
      for (int k = 0; i + k <= steps; ++k) {
        const glm::vec3 place = (float(i) * mesh->positions[0] + float(k) * mesh->positions[1] +
                                 float(steps - i - k) * mesh->positions[2]) /
                                float(steps);
        nearest = std::min(nearest, glm::distance(point, glm::dvec3(place)));
      }
    Node root(std::make_shared<Transform>(glm::translate(glm::dmat4(1), glm::dvec3(1e8))));
    root.addChild(std::make_shared<Geometry>(mesh));
    const double distance = distanceTo(root, point + glm::dvec3(1e8));
    EXPECT_LE(distance, nearest + 1e-6);
    EXPECT_GT(distance, nearest - 0.05);
  }
  EXPECT_EQ(distanceTo(Node(), {}), std::numeric_limits<double>::infinity());
}

TEST(Frame, IsAsLargeAsWhatIsSeenWhereverThatIs) {
  for (const double scale : {1e-12, 1e-6, 1.0, 1e9, 1e14})
    for (const glm::dvec3 place : {glm::dvec3(0), scale * glm::dvec3(1e9, -3e8, 1e9)}) {
      Node root(
          std::make_shared<Transform>(glm::scale(glm::translate(glm::dmat4(1), place), glm::dvec3(scale))));
      root.addChild(std::make_shared<Geometry>(std::make_shared<Mesh>(makeSphere())));
      const Camera camera = frame(root, {0.3f, 0.4f, 1.0f}, 1.0f);
      const double distance = glm::distance(camera.position(), place);
      EXPECT_NEAR(distance / scale, 1.06 / std::sin(0.25), 0.2);
      EXPECT_LT(double{camera.nearPlane}, distance - scale);
      EXPECT_GT(double{camera.nearPlane}, 0.8 * (distance - scale));
      EXPECT_GT(double{camera.farPlane}, distance + scale);
    }
}

TEST(Frame, ShowsASinglePoint) {
  const auto point = std::make_shared<Mesh>();
  point->positions = {{3, 4, 5}};
  point->indices = {0};
  point->topology = Topology::Points;
  const Node root(std::make_shared<Geometry>(point));
  const Camera camera = frame(root, {1, 1, 1}, 1.0f);
  const glm::vec4 clip = camera.projection(1.0f) * camera.view * glm::vec4(3, 4, 5, 1);
  EXPECT_GT(clip.w, 0.0f);
  EXPECT_LT(glm::length(glm::vec3(clip) / clip.w), 1.0f);
}

}  // namespace
}  // namespace weft
