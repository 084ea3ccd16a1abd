#include "ResolutionControl.h"

namespace weft {
namespace {

constexpr double kQuick = 60.0;  // milliseconds of a frame that may follow a drag
constexpr int kCoarsest = 4;
constexpr std::chrono::milliseconds kRest(200);

}  // namespace

void ResolutionControl::drawn(double milliseconds, int divisor) {
  milliseconds_ = milliseconds * divisor * divisor;
}

int ResolutionControl::divisor(Time now) const {
  if (now >= rest()) return 1;
  int divisor = 1;
  while (divisor < kCoarsest && milliseconds_ / (divisor * divisor) > kQuick) ++divisor;
  return divisor;
}

ResolutionControl::Time ResolutionControl::rest() const {
  return lastMove_ + kRest;
}

}  // namespace weft
