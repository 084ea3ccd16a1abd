// samples/embed-glfw.cpp, three frames in a window of Xvfb.
#include <gtest/gtest.h>

#ifndef WEFT_GLFW

TEST(GlfwSample, SharesItsContextWithWeft) {
  GTEST_SKIP() << "built without GLFW: install libglfw3-dev";
}

#else

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "CheckedWindow.h"
#include "ConstantField.h"
#include "WindowPicture.h"
#include "XServer.h"
#include "weft/io/ImageFile.h"

namespace {

weft::Image latestPicture;
int frames = 0;

void finishFrame(GLFWwindow* window) {
  latestPicture = weft::test::windowPicture();
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  glfwSwapBuffers(window);
  glfwSetWindowShouldClose(window, ++frames == 3);
}

}  // namespace

#define main runGlfwSample
#define PassiveWindow CheckedWindow
#define glfwSwapBuffers finishFrame
#include "../../samples/embed-glfw.cpp"
#undef main
#undef PassiveWindow
#undef glfwSwapBuffers

TEST(GlfwSample, SharesItsContextWithWeft) {
  const auto server = weft::test::XServer::start();
  if (!server) GTEST_SKIP() << "no Xvfb: install xvfb";
  const std::filesystem::path folder = weft::test::testFolder();
  std::string field = folder / "green.rf.exr";
  weft::test::writeConstantField(field, {0.1f, 0.8f, 0.1f});
  char* arguments[] = {nullptr, field.data()};
  ASSERT_EQ(runGlfwSample(2, arguments), 0);
  weft::test::requireDone(weft::writePng(folder / "window.png", latestPicture));
  EXPECT_EQ(frames, 3);

  const weft::Camera camera = weft::Camera::lookAt({2, 2, 4}, {0, 0, 0});
  const glm::mat4 viewProjection = camera.projection(1) * camera.view;
  const auto color = [&](glm::vec3 point) {
    return weft::test::colorAt(latestPicture, viewProjection, point);
  };
  const glm::vec3 orange(255, 153, 0), towardsCamera = 1.27f * glm::normalize(glm::vec3(2, 0, 4));
  EXPECT_EQ(color(towardsCamera), orange) << "the ring before the ball";
  EXPECT_EQ(color({1.27f, 0, 0.1f}), orange) << "the half drawn before";
  EXPECT_EQ(color({1.27f, 0, -0.1f}), orange) << "the half drawn after";
  EXPECT_EQ(color({-1.5f, -1.5f, 0}), glm::vec3(0)) << "what nobody draws";
  const glm::vec3 hidden = color(-towardsCamera), ball = color({0.3f, 0.3f, 0.9f});
  EXPECT_GT(hidden.g, 2 * hidden.r) << "the ring behind the ball";
  // Linear 0.8 x 3 / pi x cosine is above 0.6, encoded above 200.
  EXPECT_GT(ball.g, 200) << "colours are encoded";
  EXPECT_GT(ball.g, 2 * ball.r);
}

#endif
