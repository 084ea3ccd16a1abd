#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "RecentFiles.h"
#include "ViewerState.h"

namespace weft {

/// What a viewer says and lets people change, in Dear ImGui's frame.
class ViewerPanel {
 public:
  /// What the panel cannot know from the state.
  struct Status {
    std::string doing;          ///< in the background; empty: nothing
    double milliseconds = 0.0;  ///< of the latest frame
    int divisor = 1;            ///< of its resolution
  };

  void draw(ViewerState& state, const RecentFiles& recent, const Status& status);

  void toggle() { isOpen_ = !isOpen_; }
  void toggleHelp() { showsHelp_ = !showsHelp_; }

 private:
  void drawPanel(ViewerState& state, const RecentFiles& recent, const Status& status);

  bool isOpen_ = true;
  bool showsHelp_ = false;
};

}  // namespace weft
