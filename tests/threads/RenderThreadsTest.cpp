#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <mutex>
#include <thread>
#include <vector>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/Light.h"

namespace weft {
namespace {

class ThreadsTest : public test::GlTest {};

TEST_F(ThreadsTest, BuildAndDestroyScenesWhileTheirCoresAreDrawn) {
  const auto image = std::make_shared<Image>(1, 1, 3);
  image->bytes = {255, 255, 255};
  const auto shared = std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(1), image});
  const auto mesh = std::make_shared<Geometry>(test::square());
  const auto light = std::make_shared<DirectionalLight>(glm::vec3(3.1415927f));
  const auto sceneOf = [&](std::shared_ptr<const Material> material) {
    auto root = std::make_shared<Node>(light);
    root->addChild(std::make_shared<MaterialGroup>(std::move(material)))->addChild(mesh);
    return root;
  };

  std::mutex mutex;
  std::shared_ptr<Node> handedOver;
  bool finished = false;
  std::thread builder([&] {
    for (int i = 0; i < 30; ++i) {
      const float grey = 0.1f * static_cast<float>(i % 5 + 1);
      auto own = sceneOf(std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(grey)}));
      own->addChild(sceneOf(shared));
      own->removeChild(*own->children().back());
      const std::scoped_lock lock(mutex);
      std::swap(handedOver, own);  // what was not drawn dies here, its material too
    }
    const std::scoped_lock lock(mutex);
    finished = true;
  });

  const auto root = sceneOf(shared);
  bool last = false;
  while (!last) {
    EXPECT_NEAR(picture(*root).at(4, 4, 0), 1.0f, 1e-3f);
    std::shared_ptr<Node> other;
    {
      const std::scoped_lock lock(mutex);
      std::swap(other, handedOver);
      last = finished;
    }
    if (!other) continue;
    EXPECT_GT(picture(*other).at(4, 4, 0), 0.05f);
    std::thread([&other] { other.reset(); }).join();  // drawn here, destroyed elsewhere
  }
  builder.join();
}

TEST_F(ThreadsTest, WithContextsOfTheirOwnDrawTheSameScene) {
  Node root(std::make_shared<DirectionalLight>(glm::vec3(test::kPi)));
  root.addChild(test::dressed(std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(0, 1, 1, 1)})));
  std::vector<glm::vec3> seen(2);
  std::vector<std::thread> threads;
  for (glm::vec3& color : seen)
    threads.emplace_back([&root, &color] {
      const auto own = test::valueOf(HeadlessWindow::create(true));
      RenderAction ownRenderer;
      const RenderTarget target(8, 8);
      for (int frame = 0; frame < 3; ++frame)
        ASSERT_TRUE(ownRenderer.render(own->context(), root, test::squareCamera(), target));
      const FloatImage picture = target.read(own->context());
      const auto texel = picture.texel(4, 4);
      color = {texel[0], texel[1], texel[2]};
    });
  for (std::thread& thread : threads) thread.join();
  for (const glm::vec3& color : seen) EXPECT_LT(glm::distance(color, glm::vec3(0, 1, 1)), 1e-3f);
}

}  // namespace
}  // namespace weft
