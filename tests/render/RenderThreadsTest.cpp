#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "GlTest.h"
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

}  // namespace
}  // namespace weft
