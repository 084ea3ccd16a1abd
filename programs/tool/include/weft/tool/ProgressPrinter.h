#pragma once

#include <chrono>
#include <string>

namespace weft {

/// Tells people how far long work is: on a terminal one line that is rewritten, otherwise a line
/// every 10 s.
class ProgressPrinter {
 public:
  /// `amount` `unit`s are done at fraction 1; 0 prints no rate.
  ProgressPrinter(std::string label, double amount, std::string unit, bool terminal);

  void update(double fraction);

  /// "fit 43 %, 812 texels/s, 1:05 left".
  static std::string line(const std::string& label, double fraction, double seconds, double amount,
                          const std::string& unit);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  double amount_;
  std::string unit_;
  bool terminal_;
  bool done_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace weft
