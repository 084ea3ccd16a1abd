// weft-view in a display in memory.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <string_view>
#include <thread>

#include "ConstantField.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "ViewerDriver.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::ViewerDriver;
using testing::HasSubstr;

class Viewer : public testing::Test {
 protected:
  void SetUp() override {
    if (test::XServer::start()) return;
    const char* ci = std::getenv("CI");
    if (ci && std::string_view(ci) == "true") FAIL() << "no Xvfb: install xvfb";
    GTEST_SKIP() << "no Xvfb: install xvfb";
  }

  fs::path field(const std::string& name, glm::vec3 color) const {
    test::writeConstantField(folder / name, color);
    return folder / name;
  }

  /// Channels of the middle of a picture that are the brightest there.
  static bool isMostly(const Image& picture, int channel) {
    const auto pixel = picture.pixel(picture.width / 2, picture.height / 2);
    for (int other = 0; other < 3; ++other)
      if (other != channel &&
          pixel[static_cast<std::size_t>(other)] + 30 > pixel[static_cast<std::size_t>(channel)])
        return false;
    return true;
  }

  const fs::path folder = test::testFolder();
};

TEST_F(Viewer, IsDrivenByKeysMouseAndDrops) {
  const auto viewer =
      ViewerDriver::start({field("red.rf.exr", {0.8f, 0.1f, 0.1f}), "--size", "400x300"}, folder);
  ASSERT_TRUE(viewer->waitForTitle("red.rf.exr"));
  const Image first = viewer->screenshot();
  ASSERT_EQ(first.width, 400);
  EXPECT_TRUE(isMostly(first, 0)) << "what is shown is red";

  viewer->press("F1");
  viewer->press("F1");
  viewer->drag(1, 350, 60, -60, 20);
  const Image turned = viewer->screenshot();
  EXPECT_NE(turned.bytes, first.bytes) << "a drag turns the camera";
  viewer->drag(3, 350, 60, -60, 80);
  const Image relit = viewer->screenshot();
  EXPECT_NE(relit.bytes, turned.bytes) << "a drag of the right button moves the light";
  viewer->press("f");
  const Image framed = viewer->screenshot();
  viewer->drag(2, 350, 60, 20, 20);
  viewer->press("f");
  EXPECT_EQ(viewer->screenshot().bytes, framed.bytes) << "F shows all again";

  std::ofstream(folder / "broken.rf.exr") << "no field";
  viewer->drop(folder / "broken.rf.exr");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(viewer->screenshot().bytes, framed.bytes) << "a broken file changes nothing";
  viewer->drop(field("green.rf.exr", {0.1f, 0.8f, 0.1f}));
  ASSERT_TRUE(viewer->waitForTitle("green.rf.exr"));
  EXPECT_TRUE(isMostly(viewer->screenshot(), 1)) << "a good one is shown";

  field("green.rf.exr", {0.1f, 0.1f, 0.8f});
  bool blue = false;
  for (int i = 0; i < 50 && !blue; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    blue = isMostly(viewer->screenshot(), 2);
  }
  EXPECT_TRUE(blue) << "a file that changes is read again";
  viewer->press("q", "Control_L");
  EXPECT_EQ(viewer->exitCode(), 0);
  std::ifstream recent(folder / "state" / "weft" / "recent");
  std::string line;
  std::getline(recent, line);
  EXPECT_EQ(line, folder / "green.rf.exr");
}

TEST_F(Viewer, SaysWhatIsMissing) {
  const auto server = test::XServer::start();
  const auto fails = [&](const std::string& message) {
    const test::ProgramRun run = test::runProgram("weft-view", {"shape:cloth"});
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.err, HasSubstr(message));
  };
  setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
  fails("a window needs OpenGL 4.5, and this display has 3.3");
  unsetenv("MESA_GL_VERSION_OVERRIDE");
  setenv("DISPLAY", ":99999", 1);
  fails("no window can be opened");
}

TEST_F(Viewer, TimesADrag) {
  const auto server = test::XServer::start();
  const test::ProgramRun run =
      test::runProgram("weft-view", {"shape:cloth", "--size", "64x48", "--frames", "3", "--json", "-"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\"first_frame_ms\""));
  EXPECT_EQ(test::runProgram("weft-view", {"--frames", "3"}).exitCode, 1) << "of nothing";
  const test::ProgramRun broken = test::runProgram("weft-view", {folder / "no.glb", "--frames", "3"});
  EXPECT_EQ(broken.exitCode, 2);
  EXPECT_THAT(broken.err, HasSubstr("no.glb"));
}

}  // namespace
}  // namespace weft
