#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "FlatScene.h"
#include "RandomTree.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Pick.h"

// What the graph promises to threads; the preset thread-sanitize builds and runs these tests with
// ThreadSanitizer.

namespace weft {
namespace {

/// Cores that every thread uses.
struct SharedCores {
  std::shared_ptr<Transform> place =
      std::make_shared<Transform>(glm::translate(glm::mat4(1), glm::vec3(0, 0, -1)));
  std::shared_ptr<MaterialGroup> material =
      std::make_shared<MaterialGroup>(std::make_shared<test::PlainMaterial>());
  std::shared_ptr<Geometry> plane = std::make_shared<Geometry>(std::make_shared<Mesh>(makePlane()));

  std::shared_ptr<Node> branch(int objects) const {
    auto root = std::make_shared<Node>(material);
    for (int i = 0; i < objects; ++i) root->addChild(place)->addChild(plane);
    return root;
  }
};

template <class Work>
void onThreads(int count, Work work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
}

std::size_t objectsBelow(const Node& root) {
  FlatScene& scene = FlatScene::of(root);
  const auto lock = scene.look();
  return scene.objects().used();
}

TEST(Threads, BuildTheBranchesOfOneTreeFromSharedCores) {
  const SharedCores cores;
  std::vector<std::shared_ptr<Node>> branches(4);
  onThreads(4, [&](int i) {
    auto branch = cores.branch(200);
    for (int k = 0; k < 50; ++k) branch->removeChild(*branch->children()[static_cast<std::size_t>(k)]);
    for (int k = 0; k < 20; ++k) branch->children()[static_cast<std::size_t>(k)]->setCore(cores.plane);
    branches[static_cast<std::size_t>(i)] = std::move(branch);
  });
  Node root;
  for (auto& branch : branches) root.addChild(branch);
  EXPECT_EQ(objectsBelow(root), 4u * 170);
  cores.place->setMatrix(glm::mat4(1));
  EXPECT_EQ(objectsBelow(root), 4u * 170);
  EXPECT_EQ(boundsOf(root).maximum, glm::dvec3(0.5, 0.5, 0.0)) << "a shared core moves all its nodes";

  // And let them go again, all at once.
  for (auto& branch : branches) branch = root.removeChild(*branch);
  onThreads(4, [&](int i) { branches[static_cast<std::size_t>(i)].reset(); });
  EXPECT_EQ(objectsBelow(root), 0u);
}

TEST(Threads, BuildTreesWhileAnotherThatSharesTheirCoresIsLookedAt) {
  const SharedCores cores;
  Node root;
  root.addChild(cores.branch(50));
  std::atomic<bool> built = false;
  std::thread builder([&] {
    for (int i = 0; i < 20; ++i) EXPECT_EQ(objectsBelow(*cores.branch(100)), 100u);
    built = true;
  });
  onThreads(3, [&](int) {
    do {
      const auto hit = pick(root, {{0.1f, 0.2f, 1}, {0, 0, -1}});
      ASSERT_TRUE(hit);
      EXPECT_DOUBLE_EQ(hit->distance, 2.0);
    } while (!built);
  });
  builder.join();
}

}  // namespace
}  // namespace weft
