#include "weft/core/Version.h"
#include "weft/scenegraph.h"

#if WEFT_VERSION_MAJOR == 0 && WEFT_VERSION_MINOR < 2
#error "one header a component came with 0.2"
#endif

int main() {
  weft::Node scene;
  scene.addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeSphere())));
  return weft::boundsOf(scene).empty() ? 1 : 0;
}
