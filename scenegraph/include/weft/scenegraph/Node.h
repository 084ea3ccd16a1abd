#pragma once

#include <memory>
#include <string>
#include <vector>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// A place in the scene: a core and children. A tree may be built on any thread and is not changed while it
/// is rendered.
class Node {
 public:
  explicit Node(std::shared_ptr<const NodeCore> core = std::make_shared<Group>(), std::string name = {})
      : core_(std::move(core)), name_(std::move(name)) {}

  const NodeCore& core() const { return *core_; }
  const std::string& name() const { return name_; }
  const std::vector<std::shared_ptr<Node>>& children() const { return children_; }

  void addChild(std::shared_ptr<Node> child) { children_.push_back(std::move(child)); }
  /// Adds a new child with this core and returns it, to hang more below it.
  std::shared_ptr<Node> addChild(std::shared_ptr<const NodeCore> core, std::string name = {}) {
    children_.push_back(std::make_shared<Node>(std::move(core), std::move(name)));
    return children_.back();
  }

 private:
  std::shared_ptr<const NodeCore> core_;
  std::string name_;
  std::vector<std::shared_ptr<Node>> children_;
};

}  // namespace weft
