#include "weft/scenegraph/Traversal.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <map>
#include <memory>
#include <string>

#include "weft/scenegraph/Switch.h"

namespace weft {
namespace {

/// a (b (c d) e (f))
std::shared_ptr<Node> smallTree() {
  const auto group = std::make_shared<Group>();
  auto a = std::make_shared<Node>(group, "a");
  const auto b = a->addChild(std::make_shared<Switch>(Switch::kNone), "b");
  b->addChild(group, "c");
  b->addChild(group, "d");
  a->addChild(group, "e")->addChild(group, "f");
  return a;
}

/// The names that are seen where `wishes` are answered, Continue otherwise.
std::string seen(const std::map<std::string, Visit>& wishes, bool& finished) {
  std::string names;
  const std::shared_ptr<const Node> root = smallTree();
  finished = traverse(*root, [&](const Node& node, const glm::dmat4&) {
    names += node.name();
    const auto wish = wishes.find(node.name());
    return wish == wishes.end() ? Visit::Continue : wish->second;
  });
  return names;
}

TEST(Traversal, ShowsParentsFirstAndChildrenInTheirOrder) {
  bool finished = false;
  EXPECT_EQ(seen({}, finished), "abcdef");
  EXPECT_TRUE(finished);
}

TEST(Traversal, SkipsWhatIsBelow) {
  bool finished = false;
  EXPECT_EQ(seen({{"b", Visit::Skip}}, finished), "abef");
  EXPECT_EQ(seen({{"a", Visit::Skip}}, finished), "a");
  EXPECT_TRUE(finished);
}

TEST(Traversal, Stops) {
  bool finished = true;
  EXPECT_EQ(seen({{"d", Visit::Stop}}, finished), "abcd");
  EXPECT_FALSE(finished);
}

TEST(Traversal, KnowsWhereNodesAre) {
  Node root(std::make_shared<Transform>(glm::translate(glm::mat4(1), glm::vec3(1, 0, 0))));
  const auto doubled = std::make_shared<Transform>(glm::scale(glm::mat4(1), glm::vec3(2)));
  root.addChild(doubled)->addChild(
      std::make_shared<Transform>(glm::translate(glm::mat4(1), glm::vec3(0, 3, 0))));
  root.addChild(std::make_shared<Group>());
  std::vector<glm::vec3> origins;
  traverse(root, [&](const Node&, const glm::dmat4& toWorld) {
    origins.emplace_back(toWorld[3]);
    return Visit::Continue;
  });
  EXPECT_EQ(origins, (std::vector<glm::vec3>{{1, 0, 0}, {1, 0, 0}, {1, 6, 0}, {1, 0, 0}}));
}

TEST(Traversal, MayChangeWhatItSees) {
  const auto root = smallTree();
  const auto geometryless = std::make_shared<Group>();
  traverse(*root, [&](Node& node, const glm::dmat4&) {
    if (node.name() == "b") node.removeChild(*node.children().front());
    if (node.name() == "e") node.addChild(geometryless, "g");
    return Visit::Continue;
  });
  std::string names;
  traverse(*root, [&](const Node& node, const glm::dmat4&) {
    names += node.name();
    return Visit::Continue;
  });
  EXPECT_EQ(names, "abdefg");
}

TEST(Traversal, GoesAnyDepth) {
  Node root;
  Node* deepest = &root;
  for (int i = 0; i < 100000; ++i) deepest = deepest->addChild(std::make_shared<Group>()).get();
  std::size_t count = 0;
  traverse(root, [&](const Node&, const glm::dmat4&) {
    ++count;
    return Visit::Continue;
  });
  EXPECT_EQ(count, 100001u);
}

}  // namespace
}  // namespace weft
