#include "FlatScene.h"

#include <gtest/gtest.h>

#include <map>

#include "RandomTree.h"
#include "weft/scenegraph/Bounds.h"

namespace weft {
namespace {

using test::RandomTree;
using test::Shown;

std::map<const Node*, Shown> expected(const Node& root, glm::dvec3 eye) {
  std::vector<Shown> shown;
  test::findShown(root, eye, {}, shown);
  std::map<const Node*, Shown> byNode;
  for (const Shown& each : shown) byNode[each.node] = each;
  return byNode;
}

void expectSame(const FlatObject& object, const FlatScene& scene, std::uint32_t number, const Shown& shown) {
  const auto& geometry = static_cast<const Geometry&>(shown.node->core());
  EXPECT_EQ(scene.meshes()[object.mesh].mesh, geometry.mesh());
  EXPECT_EQ(scene.materials()[object.material].material.get(), shown.material);
  EXPECT_EQ(object.mirrored, glm::determinant(glm::dmat3(shown.toWorld)) < 0.0);
  const glm::mat3 rows = glm::transpose(glm::dmat3(shown.toWorld));
  for (int row = 0; row < 3; ++row) EXPECT_EQ(object.model.rows[row], glm::vec4(rows[row], 0.0f));
  EXPECT_EQ(scene.boxes().center(number),
            glm::dvec3(shown.toWorld * glm::dvec4(geometry.bounds().center(), 1.0)));
}

/// Compares the tables with a plain walk over the tree.
void expectEqual(const Node& root, glm::dvec3 eye) {
  FlatScene& scene = FlatScene::of(root);
  const auto lock = scene.look();
  std::map<const Node*, Shown> shown = expected(root, eye);
  std::size_t used = 0;
  for (std::uint32_t number = 0; number < scene.objects().all().size(); ++number) {
    const FlatObject& object = scene.objects()[number];
    if (!object.node) continue;
    ++used;
    if (!scene.shows(object.level, eye)) continue;
    const auto place = shown.find(object.node);
    ASSERT_NE(place, shown.end()) << "an object that is not shown";
    expectSame(object, scene, number, place->second);
    shown.erase(place);
  }
  EXPECT_EQ(scene.objects().used(), used);
  std::size_t lights = 0;
  for (const PlacedLight& light : scene.lights().all())
    if (light.core && scene.shows(light.level, eye)) ++lights;
  EXPECT_EQ(shown.size(), lights) << "what is left of the shown nodes are lights";
}

TEST(FlatScene, SaysAfterAnyChangesWhatTheTreeShows) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomTree tree(seed);
    for (int round = 0; round < 40; ++round) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", round " << round);
      expectEqual(tree.root(), tree.point(6.0f));
      if (testing::Test::HasFailure()) return;
      for (std::size_t changes = tree.below(4) + 1; changes > 0; --changes) tree.change();
    }
  }
}

TEST(FlatScene, OfABranchIsItsOwn) {
  RandomTree tree(3);
  const std::shared_ptr<Node> branch = tree.root().children().front();
  for (int round = 0; round < 100 && branch->parent() && !branch->children().empty(); ++round) {
    expectEqual(tree.root(), {});
    expectEqual(*branch, {});
    expectEqual(*branch->children().front(), {});
    tree.change();
  }
}

/// 100 branches of 100 objects.
struct Grid {
  Grid() {
    const auto mesh = std::make_shared<Geometry>(std::make_shared<Mesh>(makePlane()));
    for (int i = 0; i < 100; ++i) {
      branches.push_back(std::make_shared<Transform>());
      const auto branch = root.addChild(branches.back());
      for (int k = 0; k < 100; ++k) branch->addChild(mesh);
    }
  }
  /// How many nodes the next look places anew.
  std::size_t updated() const {
    FlatScene& scene = FlatScene::of(root);
    const auto lock = scene.look();
    return scene.updatedNodes();
  }

  Node root;
  std::vector<std::shared_ptr<Transform>> branches;
};

TEST(FlatScene, LooksOnlyAtWhatChanged) {
  Grid grid;
  EXPECT_EQ(grid.updated(), 1u + 100 + 10000);
  EXPECT_EQ(grid.updated(), 0u);
  grid.branches[7]->setMatrix(glm::translate(glm::mat4(1), glm::vec3(1)));
  EXPECT_EQ(grid.updated(), 101u);
  grid.root.children()[50]->addChild(std::make_shared<PointLight>(glm::vec3(1)));
  EXPECT_EQ(grid.updated(), 1u);
  grid.root.removeChild(*grid.root.children()[20]);
  EXPECT_EQ(grid.updated(), 0u);
  grid.root.children()[0]->children()[99]->setCore(std::make_shared<Group>());
  EXPECT_EQ(grid.updated(), 1u);
  EXPECT_EQ(grid.updated(), 0u);
  EXPECT_EQ(FlatScene::of(grid.root).objects().used(), 9899u);
}

TEST(FlatScene, ABrotherThatLeavesChangesWhatASwitchShows) {
  Node root(std::make_shared<Switch>(1));
  const auto mesh = std::make_shared<Mesh>(makePlane());
  for (int i = 0; i < 4; ++i) root.addChild(std::make_shared<Geometry>(mesh), std::to_string(i));
  const auto shown = [&] {
    FlatScene& scene = FlatScene::of(root);
    const auto lock = scene.look();
    EXPECT_EQ(scene.objects().used(), 1u);
    for (const FlatObject& object : scene.objects().all())
      if (object.node) return object.node->name();
    return std::string();
  };
  EXPECT_EQ(shown(), "1");
  root.removeChild(*root.children()[0]);
  EXPECT_EQ(shown(), "2");
  root.removeChild(*root.children()[1]);
  EXPECT_EQ(shown(), "3");
}

}  // namespace
}  // namespace weft
