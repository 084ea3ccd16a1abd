#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string_view>

#include "TestScene.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/RenderAction.h"

namespace weft::test {

/// A test that draws: `window` has a current debug context, and whatever GL calls an error fails
/// the test.
///
/// Without GL the test is skipped, but fails where CI is "true", so that it cannot quietly stop
/// testing.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    auto created = HeadlessWindow::create(true);
    if (created) {
      window = std::move(*created);
      return;
    }
    const char* ci = std::getenv("CI");
    if (ci && std::string_view(ci) == "true") FAIL() << created.error().message();
    GTEST_SKIP() << created.error().message();
  }

  void TearDown() override {
    if (!window) return;
    window->makeCurrent();
    if (const auto errors = context().takeErrors(); !errors) ADD_FAILURE() << errors.error().message();
  }

  GLContext& context() { return window->context(); }

  /// The picture of a scene in floats, as squareCamera() sees it.
  FloatImage picture(const Node& root, int width = 8, int height = 8, const RenderOptions& options = {}) {
    const RenderTarget target(width, height, Precision::Float);
    if (const auto rendered = renderer.render(context(), root, squareCamera(), target, options); !rendered)
      ADD_FAILURE() << rendered.error().message();
    return target.read(context());
  }

  std::unique_ptr<HeadlessWindow> window;
  RenderAction renderer;
};

}  // namespace weft::test
