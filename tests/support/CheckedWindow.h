#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "GlSnapshot.h"
#include "weft/scenegraph/PassiveWindow.h"

namespace weft {

/// PassiveWindow for tests that put it into a host program's place of that: every frame must leave
/// GL's state as it was, without an error of GL.
class CheckedWindow {
 public:
  static Result<std::unique_ptr<CheckedWindow>> adopt() {
    WEFT_TRY(auto window, PassiveWindow::adopt());
    return std::make_unique<CheckedWindow>(std::move(window));
  }

  explicit CheckedWindow(std::unique_ptr<PassiveWindow> window) : window_(std::move(window)) {}

  Result<void> render(const Node& root, const Camera& camera) {
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "of the host";
    const test::GlSnapshot before = test::takeHostSnapshot();
    const auto rendered = window_->render(root, camera);
    EXPECT_TRUE(rendered) << rendered.error().message();
    EXPECT_EQ(test::difference(test::takeHostSnapshot(), before), "");
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "of Weft";
    return rendered;
  }

 private:
  std::unique_ptr<PassiveWindow> window_;
};

}  // namespace weft
