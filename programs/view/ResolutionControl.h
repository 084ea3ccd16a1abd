#pragma once

#include <chrono>

namespace weft {

/// How finely a viewer draws: at full resolution, but while something moves as coarsely as it takes
/// for frames to be quick.
class ResolutionControl {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Something was dragged, and the picture has to follow.
  void moved(Time now) { lastMove_ = now; }
  /// A frame was drawn with this divisor, in so many milliseconds.
  void drawn(double milliseconds, int divisor);
  /// What was measured so far says nothing of what comes.
  void forget() { milliseconds_ = 0.0; }

  /// What both sides of the picture are divided by now, 1 to 4.
  int divisor(Time now) const;
  /// When the picture has to be drawn again at full resolution, if nothing moves until then.
  Time rest() const;

 private:
  Time lastMove_{};
  double milliseconds_ = 0.0;  ///< that a frame takes at full resolution; 0: not known
};

}  // namespace weft
