#include "weft/scenegraph/Bounds.h"

#include <gtest/gtest.h>

#include <cmath>
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
  EXPECT_EQ(bounds.minimum, glm::vec3(-0.5f, -2.0f, 0.0f));
  EXPECT_EQ(bounds.maximum, glm::vec3(11.0f, 2.0f, 0.0f));
  EXPECT_EQ(bounds.center(), glm::vec3(5.25f, 0.0f, 0.0f));
}

TEST(Bounds, OfNothingAreEmpty) {
  EXPECT_TRUE(boundsOf(Node()).empty());
  EXPECT_EQ(boundsOf(Node()).radius(), 0.0f);
}

TEST(Frame, ShowsAllOfTheBoundsAndFillsThePicture) {
  Bounds bounds;
  bounds.include({-3, 1, -2});
  bounds.include({1, 2, 5});
  for (const float aspect : {0.5f, 1.0f, 2.0f})
    for (const glm::vec3 from : {glm::vec3(0, 0, 1), glm::vec3(0, 5, 0), glm::vec3(-1, 0.3f, 0.7f)}) {
      const Camera camera = frame(bounds, from, aspect);
      const glm::mat4 toClip = camera.projection(aspect) * camera.view;
      float widest = 0.0f;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 point(corner & 1 ? -3 : 1, corner & 2 ? 1 : 2, corner & 4 ? -2 : 5);
        const glm::vec4 clip = toClip * glm::vec4(point, 1.0f);
        ASSERT_GT(clip.w, 0.0f);
        EXPECT_LE(std::abs(clip.z / clip.w), 1.0f);
        widest = std::max({widest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
      }
      EXPECT_LE(widest, 1.0f);
      EXPECT_GT(widest, 0.85f);
      EXPECT_GT(glm::dot(camera.position() - bounds.center(), from), 0.0f);
    }
}

}  // namespace
}  // namespace weft
