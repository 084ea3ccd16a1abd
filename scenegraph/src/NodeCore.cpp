#include "weft/scenegraph/NodeCore.h"

#include "ChangeClock.h"
#include "weft/scenegraph/Node.h"

namespace weft {

void NodeCore::changed() const {
  const std::scoped_lock lock(usersMutex_);
  for (Node* node = firstUser_; node; node = node->nextUser_) {
    node->coreChange_ = changeClock;
    node->stampBranch();
  }
}

}  // namespace weft
