#include <gtest/gtest.h>

#include "ConstantField.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

TEST(OffscreenSample, DrawsAClothIntoAPicture) {
  const auto folder = test::testFolder();
  const std::string field = folder / "green.rf.exr", output = folder / "out.png";
  test::writeConstantField(field, {0.1f, 0.8f, 0.1f});
  const auto run = test::runProgram("offscreen", {field, output});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const Image picture = test::valueOf(readImage(output));
  EXPECT_EQ(picture.width, 800);
  EXPECT_GT(picture.pixel(400, 200)[1], 150);
  EXPECT_EQ(picture.pixel(0, 0)[1], 0);

  EXPECT_EQ(test::runProgram("offscreen", {field}).exitCode, 1);
  EXPECT_EQ(test::runProgram("offscreen", {"none.rf.exr", output}).exitCode, 2);
}

}  // namespace
}  // namespace weft
