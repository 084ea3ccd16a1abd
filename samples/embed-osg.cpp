// A cloth of a fitted material among OpenSceneGraph's own nodes: embed-osg wool.rf.exr
#include <epoxy/gl.h>

#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>

#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/PassiveWindow.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

/// A scene of Weft's as a leaf of OpenSceneGraph's, in one graphics context.
class WeftDrawable : public osg::Drawable {
 public:
  explicit WeftDrawable(std::shared_ptr<const weft::Node> scene) : scene_(std::move(scene)) {
    const weft::Bounds b = weft::boundsOf(*scene_);
    const glm::vec3 low = b.minimum, high = b.maximum;
    setInitialBound({low.x, low.y, low.z, high.x, high.y, high.z});
    setSupportsDisplayList(false);
  }

  void drawImplementation(osg::RenderInfo& info) const override {
    const auto drawn = draw(*info.getState());
    if (!drawn) std::fprintf(stderr, "%s\n", drawn.error().message().c_str());
  }

  void releaseGLObjects(osg::State*) const override { window_.reset(); }

  osg::Object* cloneType() const override { return new WeftDrawable(scene_); }
  osg::Object* clone(const osg::CopyOp&) const override { return cloneType(); }

 private:
  weft::Result<void> draw(const osg::State& state) const {
    if (!window_) {
      WEFT_TRY(window_, weft::PassiveWindow::adopt());
    }
    weft::Camera camera;
    camera.view = glm::make_mat4(state.getModelViewMatrix().ptr());
    camera.ownProjection = glm::make_mat4(state.getProjectionMatrix().ptr());
    return window_->render(*scene_, camera);
  }

  std::shared_ptr<const weft::Node> scene_;
  mutable std::unique_ptr<weft::PassiveWindow> window_;
};

/// Weft's shapes stand on Y, OpenSceneGraph's on Z.
weft::Result<osg::ref_ptr<osg::Node>> makeCloth(const char* field) {
  WEFT_TRY(const auto material,
           weft::loadBTFMaterial(field, {.textureScale = glm::vec2(12), .doubleSided = true}));
  const auto cloth = std::make_shared<weft::Node>(std::make_shared<weft::MaterialGroup>(material));
  cloth->addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeDrapedCloth())));
  cloth->addChild(std::make_shared<weft::Transform>(glm::rotate(glm::mat4(1), -0.8f, glm::vec3(1, 0.5f, 0))))
      ->addChild(std::make_shared<weft::DirectionalLight>(glm::vec3(3)));
  const osg::ref_ptr<osg::MatrixTransform> upright =
      new osg::MatrixTransform(osg::Matrix::rotate(osg::PI_2, osg::X_AXIS));
  upright->addChild(new WeftDrawable(cloth));
  return osg::ref_ptr<osg::Node>(upright);
}

osg::ref_ptr<osg::Node> makeShape(osg::Shape* shape, const osg::Vec4& color) {
  const osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
  drawable->setColor(color);
  return drawable;
}

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage, on a display: embed-osg NAME.rf.exr\n", stderr), 1;
  const auto cloth = makeCloth(argv[1]);
  if (!cloth) return std::fprintf(stderr, "%s\n", cloth.error().message().c_str()), 2;
  const osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(makeShape(new osg::Box({0, 0, -0.7f}, 3.6f, 3.6f, 0.15f), {0.5f, 0.6f, 0.8f, 1}));
  root->addChild(*cloth);
  root->addChild(makeShape(new osg::Cone({0.9f, -0.9f, -0.3f}, 0.3f, 1.2f), {1, 0.6f, 0, 1}));
  osgViewer::Viewer viewer;
  viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer.setUpViewInWindow(0, 0, 800, 600);
  viewer.setSceneData(root);
  const osg::ref_ptr<osgGA::TrackballManipulator> manipulator = new osgGA::TrackballManipulator;
  manipulator->setHomePosition({1.5, -5, 3}, {0, 0, -0.2}, osg::Z_AXIS);
  viewer.setCameraManipulator(manipulator);
  return viewer.run();
}
