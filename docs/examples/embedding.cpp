#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"

// A cloth of a fitted material, lit from the front, in the current GL context (HeadlessWindow makes one).
weft::Result<void> drawCloth(weft::GLContext& context, const weft::RenderTarget& target, const char* file) {
  WEFT_TRY(const auto material, weft::loadBTFMaterial(file, {.textureScale = glm::vec2(8)}));
  weft::Node scene(std::make_shared<weft::MaterialGroup>(material));
  scene.addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeDrapedCloth())));
  scene.addChild(std::make_shared<weft::DirectionalLight>(glm::vec3(3)));
  return weft::RenderAction().render(context, scene, weft::frame(scene, {1, 1, 2}, 4.0f / 3.0f), target);
}
