#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Shapes.h"

int main() {
  weft::Node scene;
  scene.addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeSphere())));
  const bool hasGl = weft::HeadlessWindow::create().has_value();
  return hasGl && !weft::boundsOf(scene).empty() ? 0 : 1;
}
