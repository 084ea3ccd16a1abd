// samples/embed-osg.cpp, three frames in a window of Xvfb.
#include <gtest/gtest.h>

#ifndef WEFT_OPENSCENEGRAPH

TEST(OsgSample, SharesItsContextWithWeft) {
  GTEST_SKIP() << "built without OpenSceneGraph: install libopenscenegraph-dev";
}

#else

#include "CheckedWindow.h"  // before OpenSceneGraph's headers, which include GL's

#include <osgViewer/Viewer>

#include "ConstantField.h"
#include "WindowPicture.h"
#include "XServer.h"
#include "weft/io/ImageFile.h"

namespace {

weft::Image latestPicture;
osg::Matrix latestViewProjection;

struct TakePicture : osg::Camera::DrawCallback {
  void operator()(osg::RenderInfo& info) const override {
    latestPicture = weft::test::windowPicture();
    latestViewProjection =
        info.getCurrentCamera()->getViewMatrix() * info.getCurrentCamera()->getProjectionMatrix();
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  }
};

}  // namespace

namespace osgViewer {

class ShortViewer : public Viewer {
 public:
  int run() override {
    getCamera()->setFinalDrawCallback(new TakePicture);
    for (int i = 0; i < 3; ++i) frame();
    return 0;
  }
};

}  // namespace osgViewer

#define main runOsgSample
#define PassiveWindow CheckedWindow
#define Viewer ShortViewer
#include "../../samples/embed-osg.cpp"
#undef main
#undef PassiveWindow
#undef Viewer

TEST(OsgSample, SharesItsContextWithWeft) {
  const auto server = weft::test::XServer::start();
  if (!server) GTEST_SKIP() << "no Xvfb: install xvfb";
  const std::filesystem::path folder = weft::test::testFolder();
  std::string field = folder / "green.rf.exr";
  weft::test::writeConstantField(field, {0.1f, 0.8f, 0.1f});
  char* arguments[] = {nullptr, field.data()};
  ASSERT_EQ(runOsgSample(2, arguments), 0);
  weft::test::requireDone(weft::writePng(folder / "window.png", latestPicture));

  const glm::mat4 viewProjection = glm::make_mat4(latestViewProjection.ptr());
  const auto color = [&](glm::vec3 point) {
    return weft::test::colorAt(latestPicture, viewProjection, point);
  };
  const glm::vec3 cloth = color({0, 0, 0.65f}), cone = color({0.9f, -0.9f, -0.2f}),
                  floor = color({-1.7f, 0, -0.62f});
  EXPECT_GT(cloth.g, 150);
  EXPECT_GT(cloth.g, 2 * cloth.r) << "Weft's";
  EXPECT_GT(cone.r, 2 * cone.b) << "OpenSceneGraph's, before the cloth";
  EXPECT_GT(floor.b, floor.r) << "OpenSceneGraph's";
  EXPECT_EQ(color({0, 5, -0.6f}), glm::vec3(51, 51, 102)) << "its background";
}

#endif
