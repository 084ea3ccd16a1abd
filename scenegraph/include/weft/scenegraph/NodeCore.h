#pragma once

namespace weft {

/// What a Node does: a transform, a geometry, a material for everything below, a light. One core may be
/// shared by many nodes (instancing), so it knows nothing of where it hangs.
class NodeCore {
 public:
  virtual ~NodeCore() = default;

 protected:
  NodeCore() = default;
  NodeCore(const NodeCore&) = default;
  NodeCore& operator=(const NodeCore&) = default;
};

/// Only holds its children together.
class Group : public NodeCore {};

}  // namespace weft
