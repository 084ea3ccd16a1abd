#include "weft/scenegraph/Node.h"

#include <algorithm>
#include <utility>

#include "ChangeClock.h"
#include "FlatScene.h"
#include "weft/core/Contract.h"

namespace weft {

Node::Node(std::shared_ptr<const NodeCore> core, std::string name)
    : core_(std::move(core)), name_(std::move(name)) {
  WEFT_EXPECT(core_, "a node has a core");
  joinUsers();
}

Node::~Node() {
  leaveUsers();
  // One by one instead of by recursion, so that the depth of a tree is no matter.
  std::vector<std::shared_ptr<Node>> orphans;
  const auto orphan = [&](std::vector<std::shared_ptr<Node>>& children) {
    for (std::shared_ptr<Node>& child : children) {
      child->parent_ = nullptr;
      orphans.push_back(std::move(child));
    }
    children.clear();
  };
  orphan(children_);
  while (!orphans.empty()) {
    const std::shared_ptr<Node> node = std::move(orphans.back());
    orphans.pop_back();
    if (node.use_count() == 1) orphan(node->children_);
  }
}

void Node::setCore(std::shared_ptr<const NodeCore> core) {
  WEFT_EXPECT(core, "a node has a core");
  leaveUsers();
  core_ = std::move(core);
  joinUsers();
  coreChange_ = changeClock;
  stampBranch();
}

void Node::addChild(std::shared_ptr<Node> child) {
  WEFT_EXPECT(child && !child->parent_, "a node has one parent at most");
  WEFT_EXPECT(child.get() != this, "a node is not below itself");
  if (!child->children_.empty())
    for (const Node* above = parent_; above; above = above->parent_)
      WEFT_EXPECT(above != child.get(), "a node is not below itself");
  child->parent_ = this;
  child->attachment_ = changeClock;
  children_.push_back(std::move(child));
  childrenChange_ = changeClock;
  stampBranch();
}

std::shared_ptr<Node> Node::addChild(std::shared_ptr<const NodeCore> core, std::string name) {
  addChild(std::make_shared<Node>(std::move(core), std::move(name)));
  return children_.back();
}

std::shared_ptr<Node> Node::removeChild(const Node& child) {
  const auto place = std::find_if(children_.begin(), children_.end(),
                                  [&](const std::shared_ptr<Node>& each) { return each.get() == &child; });
  WEFT_EXPECT(place != children_.end(), "only a child can be removed");
  std::shared_ptr<Node> removed = std::move(*place);
  children_.erase(place);
  removed->parent_ = nullptr;
  childrenChange_ = changeClock;
  stampBranch();
  return removed;
}

void Node::joinUsers() {
  const std::scoped_lock lock(core_->usersMutex_);
  nextUser_ = core_->firstUser_;
  if (nextUser_) nextUser_->previousUser_ = this;
  core_->firstUser_ = this;
}

void Node::leaveUsers() {
  const std::scoped_lock lock(core_->usersMutex_);
  (previousUser_ ? previousUser_->nextUser_ : core_->firstUser_) = nextUser_;
  if (nextUser_) nextUser_->previousUser_ = previousUser_;
  previousUser_ = nextUser_ = nullptr;
}

void Node::stampBranch() {
  const std::uint64_t now = changeClock;
  const bool structure = childrenChange_ == now;
  for (Node* node = this; node; node = node->parent_) {
    if (node != this && node->branchChange_ == now && (!structure || node->childrenChange_ == now)) return;
    node->branchChange_ = now;
    if (structure) node->childrenChange_ = now;
  }
}

FlatScene& Node::flat() const {
  static std::mutex creation;
  const std::scoped_lock lock(creation);
  if (!flat_) flat_ = std::make_unique<FlatScene>(*this);
  return *flat_;
}

}  // namespace weft
