#pragma once

#include <algorithm>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <random>
#include <vector>

#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/LOD.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Switch.h"
#include "weft/scenegraph/Transform.h"
#include "weft/scenegraph/Traversal.h"

namespace weft::test {

/// A material of nothing, for trees that are not drawn.
class PlainMaterial : public Material {
 public:
  const State& state() const override { return state_; }

 private:
  State state_;
};

/// A tree of every kind of node, with shared cores, and random changes of it.
class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {
    for (int i = 0; i < 3; ++i) materials_.push_back(std::make_shared<PlainMaterial>());
    for (int i = 1; i <= 3; ++i) meshes_.push_back(std::make_shared<Mesh>(makeSphere(2 * i)));
    for (int i = 0; i < 20; ++i) addCore();
    root_->addChild(randomBranch(200));
  }

  Node& root() { return *root_; }

  void change() {
    Node& node = randomNode();
    switch (below(7)) {
      case 0:
        node.addChild(randomBranch(below(12)));
        break;
      case 1:
        if (&node != root_.get()) removeFromParent(node);
        break;
      case 2:
        move(node);
        break;
      case 3:
        if (&node != root_.get()) node.setCore(randomCore());
        break;
      case 4:
        transforms_[below(transforms_.size())]->setMatrix(randomMatrix());
        break;
      case 5:
        switches_[below(switches_.size())]->setChoice(static_cast<int>(below(5)) - 2);
        break;
      default:
        groups_[below(groups_.size())]->setMaterial(randomMaterial());
    }
  }

  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, std::max<std::size_t>(count, 1) - 1)(random_);
  }
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  glm::vec3 point(float size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

 private:
  /// Turns, stretches, mirrors, moves.
  glm::mat4 randomMatrix() {
    const glm::mat4 moved = glm::translate(glm::mat4(1), point(3.0f));
    const glm::mat4 turned = glm::rotate(moved, between(0, 6), point(1.0f) + glm::vec3(0, 0, 1.5f));
    return glm::scale(turned, glm::vec3(between(0.5f, 1.2f), between(-1.2f, -0.5f), between(0.5f, 1.2f)));
  }

  std::shared_ptr<const Material> randomMaterial() {
    return below(4) == 0 ? nullptr : materials_[below(materials_.size())];
  }

  void addCore() {
    transforms_.push_back(std::make_shared<Transform>(randomMatrix()));
    switches_.push_back(std::make_shared<Switch>(static_cast<int>(below(5)) - 2));
    groups_.push_back(std::make_shared<MaterialGroup>(randomMaterial()));
    cores_.insert(cores_.end(), {transforms_.back(), switches_.back(), groups_.back()});
    cores_.push_back(std::make_shared<LOD>(std::vector<float>{2.0f, 5.0f}, point(1.0f)));
    cores_.push_back(std::make_shared<PointLight>(glm::vec3(1.0f)));
    for (const auto& mesh : meshes_) cores_.push_back(std::make_shared<Geometry>(mesh));
    cores_.push_back(std::make_shared<Group>());
  }

  const std::shared_ptr<const NodeCore>& randomCore() { return cores_[below(cores_.size())]; }

  std::shared_ptr<Node> randomBranch(std::size_t nodes) {
    auto branch = std::make_shared<Node>(randomCore());
    std::vector<Node*> all{branch.get()};
    for (std::size_t i = 0; i < nodes; ++i)
      all.push_back(all[below(all.size())]->addChild(randomCore()).get());
    return branch;
  }

  Node& randomNode() {
    std::vector<Node*> all;
    traverse(*root_, [&](Node& node, const glm::dmat4&) {
      all.push_back(&node);
      return Visit::Continue;
    });
    return *all[below(all.size())];
  }

  static std::shared_ptr<Node> removeFromParent(Node& node) {
    return const_cast<Node*>(node.parent())->removeChild(node);
  }

  /// To another place, where that is not below itself.
  void move(Node& node) {
    Node& place = randomNode();
    for (const Node* above = &place; above; above = above->parent())
      if (above == &node) return;
    place.addChild(removeFromParent(node));
  }

  std::mt19937 random_;
  std::vector<std::shared_ptr<const Material>> materials_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<std::shared_ptr<Transform>> transforms_;
  std::vector<std::shared_ptr<Switch>> switches_;
  std::vector<std::shared_ptr<MaterialGroup>> groups_;
  std::vector<std::shared_ptr<const NodeCore>> cores_;
  std::shared_ptr<Node> root_ = std::make_shared<Node>();
};

/// A geometry or light that is shown, as a plain walk over the tree finds it.
struct Shown {
  const Node* node = nullptr;
  glm::dmat4 toWorld{1.0};
  const Material* material = nullptr;
};

/// What an eye sees of a tree, by the rules of Switch, LOD, MaterialGroup and Transform, written
/// down as recursion.
inline void findShown(const Node& node, glm::dvec3 eye, Shown above, std::vector<Shown>& shown) {
  above.node = &node;
  const auto* transform = dynamic_cast<const Transform*>(&node.core());
  const auto* group = dynamic_cast<const MaterialGroup*>(&node.core());
  const auto* choice = dynamic_cast<const Switch*>(&node.core());
  const auto* levels = dynamic_cast<const LOD*>(&node.core());
  if (transform) above.toWorld *= transform->matrix();
  if (group && !above.material) above.material = group->material().get();
  if (dynamic_cast<const Geometry*>(&node.core()) || dynamic_cast<const Light*>(&node.core()))
    shown.push_back(above);
  const auto& children = node.children();
  std::size_t first = 0, last = children.size();
  const auto only = [&](std::size_t child) { first = child, last = std::min(child + 1, children.size()); };
  if (choice && choice->choice() == Switch::kNone) return;
  if (choice && choice->choice() >= 0) only(static_cast<std::size_t>(choice->choice()));
  if (levels) {
    const double distance = glm::distance(eye, glm::dvec3(above.toWorld * glm::dvec4(levels->center(), 1)));
    const auto& ranges = levels->ranges();
    only(static_cast<std::size_t>(
        std::count_if(ranges.begin(), ranges.end(), [&](float range) { return double{range} <= distance; })));
  }
  for (std::size_t i = first; i < last; ++i) findShown(*children[i], eye, above, shown);
}

}  // namespace weft::test
