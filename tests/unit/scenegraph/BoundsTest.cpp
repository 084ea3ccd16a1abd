#include "weft/scenegraph/Bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

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
