#pragma once

#include <mutex>

namespace weft {

class Node;

/// What a Node does: a transform, a geometry, a material for everything below, a light.
///
/// One core may be shared by many nodes (instancing), also by trees that are built on different
/// threads at once. It is changed only where none of them is rendered or built.
class NodeCore {
 public:
  virtual ~NodeCore() = default;
  NodeCore& operator=(const NodeCore&) = delete;

 protected:
  NodeCore() = default;
  /// A copy stands at no node yet.
  NodeCore(const NodeCore&) : NodeCore() {}

  /// Makes the next look at a tree see what changed here, at every node that has this core.
  void changed() const;

 private:
  friend class Node;

  // The nodes that have this core, linked through Node::nextUser_.
  mutable std::mutex usersMutex_;
  mutable Node* firstUser_ = nullptr;
};

/// Only holds its children together.
class Group : public NodeCore {};

}  // namespace weft
