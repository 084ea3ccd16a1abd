#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "FileWatch.h"
#include "RecentFiles.h"
#include "ResolutionControl.h"
#include "SceneLoader.h"
#include "ScenePicture.h"
#include "ViewerPanel.h"
#include "ViewerState.h"
#include "ViewerWindow.h"
#include "weft/core/Result.h"
#include "weft/scenegraph/PassiveWindow.h"

namespace weft {

/// A viewer in its window: what happens there becomes changes of its state, and these become
/// frames.
class Viewer {
 public:
  /// The window's context is current, and both outlive this.
  static Result<std::unique_ptr<Viewer>> create(ViewerWindow& window, ViewerState& state);

  /// Until the window is closed.
  void run();

  /// What drags of the light took: whole frames, in milliseconds.
  struct Timing {
    double firstFrame = 0.0;  ///< of the scene, since `start`
    std::vector<double> frames{};
    double fullPicture = 0.0;  ///< until it was there after the end of the drag
  };
  /// Waits until the scene is there, then drags the light around for so many frames. Fails where
  /// the scene cannot be loaded.
  Result<Timing> timeDrag(int frames, std::chrono::steady_clock::time_point start);

 private:
  using Clock = std::chrono::steady_clock;

  Viewer(ViewerWindow& window, ViewerState& state);
  void listen();
  void step();
  void pressKey(int key, int modifiers);
  void pressButton(int button, int modifiers);
  void drag(glm::dvec2 movement);
  void takeLoaded();
  void watchFiles();
  void turnTable();
  bool needsScene() const;
  double patience() const;
  void drawScene();
  void drawFrame();
  void takeScreenshot();

  ViewerWindow& window_;
  ViewerState& state_;
  std::unique_ptr<PassiveWindow> weft_;
  std::unique_ptr<ScenePicture> picture_;
  SceneLoader loader_{&ViewerWindow::wake};
  RecentFiles recent_{RecentFiles::standardFile()};
  FileWatch watch_;
  ResolutionControl resolution_;
  ViewerPanel panel_;
  ViewerState::Drag drag_ = ViewerState::Drag::None;
  bool turns_ = false;
  std::uint64_t drawnRevision_ = 0;
  glm::ivec2 drawnSize_{0};
  int drawnDivisor_ = 1;
  double milliseconds_ = 0.0;
  int framesToDraw_ = 0;  ///< Dear ImGui settles in a few
  Clock::time_point nextLook_{};
  Clock::time_point latestTurn_{};
};

}  // namespace weft
