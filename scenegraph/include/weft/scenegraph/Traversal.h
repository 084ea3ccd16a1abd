#pragma once

#include <concepts>
#include <glm/ext/matrix_double4x4.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "weft/scenegraph/Node.h"
#include "weft/scenegraph/Transform.h"

namespace weft {

/// What a visitor wants to see after a node.
enum class Visit {
  Continue,  ///< what is below it, then the rest
  Skip,      ///< the rest
  Stop,      ///< nothing
};

/// Shows a visitor the root and everything below it, parents before children, children in their
/// order, however deep; also what a Switch or LOD does not show. False where it was stopped.
///
/// `visitor(node, toWorld)` returns a Visit. `toWorld` are the node's coordinates, its own
/// transform included, in those in which the root stands. It may change the node and what is below
/// it.
template <class Root, class Visitor>
requires std::same_as<std::remove_const_t<Root>, Node>
bool traverse(Root& root, Visitor visitor) {
  std::vector<std::pair<Root*, glm::dmat4>> ahead{{&root, glm::dmat4(1.0)}};
  while (!ahead.empty()) {
    auto [node, toWorld] = ahead.back();
    ahead.pop_back();
    if (const auto* transform = dynamic_cast<const Transform*>(&node->core())) toWorld *= transform->matrix();
    const Visit next = visitor(*node, std::as_const(toWorld));
    if (next == Visit::Stop) return false;
    if (next == Visit::Skip) continue;
    const auto& children = node->children();
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      ahead.emplace_back(child->get(), toWorld);
  }
  return true;
}

}  // namespace weft
