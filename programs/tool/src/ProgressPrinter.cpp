#include "weft/tool/ProgressPrinter.h"

#include <fmt/format.h>

#include "StandardStreams.h"

namespace weft {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTerminalInterval{100};
constexpr milliseconds kLogInterval{10000};

std::string clockText(double seconds) {
  const long whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

ProgressPrinter::ProgressPrinter(std::string label, double amount, std::string unit, bool terminal)
    : label_(std::move(label)),
      amount_(amount),
      unit_(std::move(unit)),
      terminal_(terminal),
      next_(start_ + (terminal ? kTerminalInterval : kLogInterval)) {}

std::string ProgressPrinter::line(const std::string& label, double fraction, double seconds, double amount,
                                  const std::string& unit) {
  if (fraction >= 1.0) return fmt::format("{} done in {:.1f} s", label, seconds);
  std::string text = fmt::format("{} {:.0f} %", label, 100.0 * fraction);
  if (fraction <= 0.0 || seconds <= 0.0) return text;
  if (amount > 0.0) text += fmt::format(", {:.3g} {}/s", fraction * amount / seconds, unit);
  return text + fmt::format(", {} left", clockText(seconds * (1.0 - fraction) / fraction));
}

void ProgressPrinter::update(double fraction) {
  const Clock::time_point now = Clock::now();
  const bool finished = fraction >= 1.0;
  if (done_ || (now < next_ && !finished)) return;
  done_ = finished;
  next_ = now + (terminal_ ? kTerminalInterval : kLogInterval);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string text = line(label_, fraction, seconds, amount_, unit_);
  printText(stderr, terminal_ ? fmt::format("\r\x1b[K{}{}", text, finished ? "\n" : "") : text + "\n");
}

}  // namespace weft
