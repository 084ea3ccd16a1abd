#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

class FlatScene;

/// A place in the scene: a core and children. It has one parent at most; what shows at several
/// places is a core that several nodes share.
///
/// A tree may be built on any thread, and its parts on several. It is not changed while it is
/// rendered. Nodes and cores note when they change, so that a frame looks again only at the
/// branches in which something did.
class Node {
 public:
  explicit Node(std::shared_ptr<const NodeCore> core = std::make_shared<Group>(), std::string name = {});
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const NodeCore& core() const { return *core_; }
  void setCore(std::shared_ptr<const NodeCore> core);
  const std::string& name() const { return name_; }
  const std::vector<std::shared_ptr<Node>>& children() const { return children_; }
  /// Null at the root.
  const Node* parent() const { return parent_; }

  /// The child must not have a parent yet and not be above this.
  void addChild(std::shared_ptr<Node> child);
  /// Adds a new child with this core and returns it, to hang more below it.
  std::shared_ptr<Node> addChild(std::shared_ptr<const NodeCore> core, std::string name = {});
  /// Takes a child out and returns it, with all that is below it.
  std::shared_ptr<Node> removeChild(const Node& child);

 private:
  friend class NodeCore;
  friend class FlatScene;

  void joinUsers();
  void leaveUsers();
  /// Carries this node's latest changes to the nodes above, up to those that have them already.
  void stampBranch();
  /// What is drawn below; made at the first call, by whichever thread.
  FlatScene& flat() const;

  std::shared_ptr<const NodeCore> core_;
  std::string name_;
  std::vector<std::shared_ptr<Node>> children_;
  Node* parent_ = nullptr;
  // The other nodes with the same core.
  Node* previousUser_ = nullptr;
  Node* nextUser_ = nullptr;
  // When it was that ... (ChangeClock.h).
  std::uint64_t coreChange_ = 0;             ///< the core changed, or was replaced
  std::uint64_t childrenChange_ = 0;         ///< a child came or went, here or below
  std::uint64_t attachment_ = 0;             ///< this came below its parent
  std::uint64_t branchChange_ = 0;           ///< any of this happened here or below
  mutable std::unique_ptr<FlatScene> flat_;  ///< of nodes that were drawn or picked from as a root
};

}  // namespace weft
