#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "LoadedView.h"
#include "weft/core/Result.h"

namespace weft {

/// Loads what a viewer shows on a thread of its own, and fits measurements there: at first a part
/// of them, quickly. Used by one thread, which also uploads.
class SceneLoader {
 public:
  /// `wake` is called, on the other thread, whenever take() has something new.
  explicit SceneLoader(std::function<void()> wake) : wake_(std::move(wake)) {}
  /// Gives up what is under way, and waits for it.
  ~SceneLoader();

  /// Starts; what was under way is given up.
  void start(ViewRequest request);
  /// The next thing that was loaded, or why it could not be; once.
  std::optional<Result<LoadedView>> take();
  /// What is being done, for people: "fitting rfnl, 43 %"; empty: nothing.
  std::string doing() const;

 private:
  struct Job {
    std::atomic<bool> stopped = false;
    std::atomic<bool> done = false;
    std::mutex mutex;  ///< of the next two
    std::string doing;
    std::vector<Result<LoadedView>> loaded;
    std::jthread thread;
  };

  std::function<void()> wake_;
  std::shared_ptr<Job> job_;
  std::vector<std::shared_ptr<Job>> givenUp_;
};

}  // namespace weft
