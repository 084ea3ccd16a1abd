// Draws a cloth of a fitted material into a picture: offscreen wool.rf.exr cloth.png
#include <cstdio>

#include "weft/io/ImageFile.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"

weft::Result<void> drawCloth(const char* field, const char* picture) {
  WEFT_TRY(const auto window, weft::HeadlessWindow::create());
  WEFT_TRY(const auto material,
           weft::loadBTFMaterial(field, {.textureScale = glm::vec2(12), .doubleSided = true}));
  weft::Node scene(std::make_shared<weft::MaterialGroup>(material));
  scene.addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeDrapedCloth())));
  scene.addChild(std::make_shared<weft::DirectionalLight>(glm::vec3(3)));

  const weft::Camera camera = weft::frame(scene, {1, 1, 2}, 4.0f / 3.0f);
  const weft::RenderTarget target(1600, 1200);
  WEFT_TRY_VOID(weft::RenderAction().render(window->context(), scene, camera, target));
  return weft::writePng(picture, target.read(window->context(), 2));  // 2 x 2 samples a pixel
}

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: offscreen NAME.rf.exr PICTURE.png\n", stderr), 1;
  const auto drawn = drawCloth(argv[1], argv[2]);
  if (!drawn) std::fprintf(stderr, "%s\n", drawn.error().message().c_str());
  return drawn ? 0 : 2;
}
