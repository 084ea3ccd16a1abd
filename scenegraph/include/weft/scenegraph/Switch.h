#pragma once

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Shows one of its node's children, all, or none: what is not shown is not drawn, lights nothing
/// and is not picked.
class Switch : public NodeCore {
 public:
  static constexpr int kAll = -1;
  static constexpr int kNone = -2;

  /// The number of a child, counted from 0, or kAll, or kNone. One that does not exist shows
  /// nothing.
  explicit Switch(int choice = kAll) : choice_(choice) {}

  int choice() const { return choice_; }
  void setChoice(int choice) {
    if (choice == choice_) return;
    choice_ = choice;
    changed();
  }

 private:
  int choice_;
};

}  // namespace weft
