#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/LOD.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Switch.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

std::shared_ptr<Transform> transformBy(glm::vec3 by, float scale = 1.0f) {
  return std::make_shared<Transform>(glm::scale(glm::translate(glm::mat4(1), by), glm::vec3(scale)));
}

/// What a frame costs and shows: a grid of squares that fills the picture, one pixel each.
class RenderStatisticsTest : public test::GlTest {
 protected:
  static constexpr int kSide = 16;

  /// `materials` in turns; every object its own mesh, or all the same.
  void fill(int materials, bool shared) {
    std::vector<std::shared_ptr<MaterialGroup>> groups;
    for (int i = 0; i < materials; ++i)
      groups.push_back(std::make_shared<MaterialGroup>(
          std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(0.1f * static_cast<float>(i + 1))})));
    const auto one = std::make_shared<Geometry>(test::square());
    for (int i = 0; i < kSide * kSide; ++i) {
      const glm::vec2 place = glm::vec2(i % kSide, i / kSide) + 0.5f - 0.5f * kSide;
      places.push_back(transformBy({place * (2.0f / kSide), 0.0f}, 1.0f / kSide));
      root.addChild(places.back())
          ->addChild(groups[static_cast<std::size_t>(i % materials)])
          ->addChild(shared ? one : std::make_shared<Geometry>(test::square()));
    }
    root.addChild(std::make_shared<DirectionalLight>(glm::vec3(3.1415927f)));
  }

  const RenderStatistics& drawn(const Camera& camera = test::squareCamera()) {
    const auto rendered = renderer.render(context(), root, camera, target);
    EXPECT_TRUE(rendered) << (rendered ? "" : rendered.error().message());
    return renderer.statistics();
  }
  float shown(int x, int y) { return target.read(context()).at(x, kSide - 1 - y, 0); }

  Node root;
  std::vector<std::shared_ptr<Transform>> places;
  RenderTarget target{kSide, kSide, Precision::Float};
};

TEST_F(RenderStatisticsTest, OneCallDrawsAllOfAMaterial) {
  fill(3, false);
  const RenderStatistics& statistics = drawn();
  EXPECT_EQ(statistics.objects, 256u);
  EXPECT_EQ(statistics.culled, 0u);
  EXPECT_EQ(statistics.triangles, 512u);
  EXPECT_EQ(statistics.draws, 256u);
  EXPECT_EQ(statistics.drawCalls, 3u);
  EXPECT_EQ(statistics.stateChanges, 3u);
  EXPECT_EQ(statistics.lights, 1u);
  for (int i = 0; i < kSide * kSide; ++i)
    EXPECT_NEAR(shown(i % kSide, i / kSide), 0.1f * static_cast<float>(i % 3 + 1), 1e-4f);
}

TEST_F(RenderStatisticsTest, ASharedCoreIsDrawnAsInstances) {
  fill(3, true);
  EXPECT_EQ(drawn().draws, 3u);
  EXPECT_EQ(drawn().drawCalls, 3u);
  EXPECT_EQ(drawn().triangles, 512u);
  for (int i = 0; i < kSide * kSide; ++i)
    EXPECT_NEAR(shown(i % kSide, i / kSide), 0.1f * static_cast<float>(i % 3 + 1), 1e-4f);
}

TEST_F(RenderStatisticsTest, WhatIsOutsideOfThePictureIsNotDrawn) {
  fill(1, true);
  Camera camera = test::squareCamera();
  camera.view = glm::translate(camera.view, glm::dvec3(-1.001, 0.0, 0.0));  // sees the right half
  EXPECT_EQ(drawn(camera).culled, 128u);
  EXPECT_EQ(renderer.statistics().triangles, 256u);
  camera.view = glm::translate(camera.view, glm::dvec3(-9.0, 0.0, 0.0));
  EXPECT_EQ(drawn(camera).culled, 256u);
  EXPECT_EQ(renderer.statistics().drawCalls, 0u);
}

TEST_F(RenderStatisticsTest, ChangingATreeCostsWhatChanged) {
  fill(2, true);
  EXPECT_EQ(drawn().updatedNodes, 1u + 3 * 256 + 1);
  EXPECT_EQ(drawn().updatedNodes, 0u);
  places[3]->setMatrix(glm::mat4(0.0f));
  EXPECT_EQ(drawn().updatedNodes, 3u);
  EXPECT_EQ(shown(3, 0), 0.0f);
  root.removeChild(*root.children()[5]);
  EXPECT_EQ(drawn().updatedNodes, 0u);
  EXPECT_EQ(shown(5, 0), 0.0f);
  EXPECT_NEAR(shown(6, 0), 0.1f, 1e-4f);
  EXPECT_EQ(renderer.statistics().objects, 255u);
}

TEST_F(RenderStatisticsTest, LinesAndPointsAreNoTriangles) {
  fill(1, true);
  for (const Topology topology : {Topology::Lines, Topology::Points}) {
    auto mesh = test::square();
    mesh->topology = topology;
    root.addChild(test::dressed(std::make_shared<LambertMaterial>(), mesh));
  }
  EXPECT_EQ(drawn().objects, 258u);
  EXPECT_EQ(drawn().triangles, 512u);
}

TEST_F(RenderStatisticsTest, ASwitchShowsItsChoice) {
  fill(1, true);
  const auto choice = std::make_shared<Switch>(1);
  const auto node = root.addChild(choice);
  for (const float grey : {0.5f, 0.75f})
    node->addChild(transformBy({0, 0, 0.5f}))
        ->addChild(test::dressed(std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(grey)})));
  const auto lamp = node->addChild(std::make_shared<DirectionalLight>(glm::vec3(3.1415927f)));
  const auto seen = [&](int shownChild) {
    choice->setChoice(shownChild);
    drawn();
    return shown(8, 8);
  };
  EXPECT_NEAR(seen(1), 0.75f, 1e-4f);
  EXPECT_NEAR(seen(0), 0.5f, 1e-4f);
  EXPECT_EQ(renderer.statistics().objects, 257u);
  EXPECT_NEAR(seen(2), 0.2f, 1e-4f) << "the lamp alone, on the grid";
  EXPECT_NEAR(seen(3), 0.1f, 1e-4f);
  EXPECT_NEAR(seen(Switch::kNone), 0.1f, 1e-4f);
  EXPECT_EQ(renderer.statistics().lights, 1u);
  seen(Switch::kAll);
  EXPECT_EQ(renderer.statistics().objects, 258u);
  EXPECT_EQ(renderer.statistics().lights, 2u);
}

TEST_F(RenderStatisticsTest, LevelsOfDetailGoByTheDistanceToTheEye) {
  root.addChild(std::make_shared<DirectionalLight>(glm::vec3(3.1415927f)));
  const auto levels = root.addChild(transformBy({0, 0, 1}))
                          ->addChild(std::make_shared<LOD>(std::vector<float>{3, 6}, glm::vec3(0, 0, -1)));
  for (const float grey : {0.25f, 0.5f})
    levels->addChild(test::dressed(std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(grey)})));
  const auto seen = [&](float distance) {
    Camera camera = Camera::lookAt({0, 0, distance}, {0, 0, 0});
    drawn(camera);
    return shown(8, 8);
  };
  EXPECT_NEAR(seen(2.9f), 0.25f, 1e-4f);
  EXPECT_NEAR(seen(3.1f), 0.5f, 1e-4f);
  EXPECT_EQ(renderer.statistics().objects, 2u);
  EXPECT_EQ(renderer.statistics().culled, 1u);
  EXPECT_EQ(renderer.statistics().updatedNodes, 0u) << "moving the eye changes no tree";
  EXPECT_EQ(seen(6.1f), 0.0f) << "there is no third child";
}

}  // namespace
}  // namespace weft
