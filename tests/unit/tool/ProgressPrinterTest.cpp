#include "weft/tool/ProgressPrinter.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(ProgressPrinter, SaysShareRateAndTimeLeft) {
  EXPECT_EQ(ProgressPrinter::line("fit", 0.0, 0.0, 0.0, ""), "fit 0 %");
  EXPECT_EQ(ProgressPrinter::line("fit", 0.25, 30.0, 0.0, ""), "fit 25 %, 1:30 left");
  EXPECT_EQ(ProgressPrinter::line("fit", 0.25, 30.0, 4096.0, "texels"), "fit 25 %, 34.1 texels/s, 1:30 left");
  EXPECT_EQ(ProgressPrinter::line("bake", 0.01, 100.0, 0.0, ""), "bake 1 %, 2:45:00 left");
  EXPECT_EQ(ProgressPrinter::line("fit", 1.0, 12.34, 4096.0, "texels"), "fit done in 12.3 s");
}

TEST(ProgressPrinter, RewritesOneLineOnATerminal) {
  testing::internal::CaptureStderr();
  ProgressPrinter printer("fit", 0.0, "", true);
  printer.update(0.5);  // too soon to be worth a line
  printer.update(1.0);
  printer.update(1.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "\r\x1b[Kfit done in 0.0 s\n");
}

}  // namespace
}  // namespace weft
