// A lamp that goes around a cloth of a fitted material: moving-light wool.rf.exr light 12
// draws one turn in 12 pictures, light-0.png and on.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>
#include <string>

#include "weft/io/ImageFile.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

weft::Result<void> drawTurn(const char* field, const std::string& name, int steps) {
  WEFT_TRY(const auto window, weft::HeadlessWindow::create());
  WEFT_TRY(const auto material,
           weft::loadBTFMaterial(field, {.textureScale = glm::vec2(12), .doubleSided = true}));
  weft::Node scene;
  const auto cloth = std::make_shared<weft::Mesh>(weft::makeDrapedCloth());
  scene.addChild(std::make_shared<weft::MaterialGroup>(material))
      ->addChild(std::make_shared<weft::Geometry>(cloth));
  const auto lamp = std::make_shared<weft::PointLight>(glm::vec3(20));  // candela
  lamp->castsShadow = true;
  const auto place = std::make_shared<weft::Transform>();  // shared with the node: it can be moved
  scene.addChild(place)->addChild(lamp);

  const weft::Camera camera = weft::frame(scene, {1, 1, 2}, 4.0f / 3.0f);
  const weft::RenderTarget target(640, 480);
  weft::RenderAction renderer;
  for (int step = 0; step < steps; ++step) {
    const double angle = glm::two_pi<double>() * step / steps;
    const glm::dvec3 around(2.5 * std::sin(angle), 2.0, 2.5 * std::cos(angle));
    place->setMatrix(glm::translate(glm::dmat4(1), around));
    WEFT_TRY_VOID(renderer.render(window->context(), scene, camera, target));
    WEFT_TRY_VOID(weft::writePng(name + "-" + std::to_string(step) + ".png",
                                 target.read(window->context(), 2)));  // 2 x 2 samples a pixel
  }
  return {};
}

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: moving-light FIELD.rf.exr PICTURE STEPS\n", stderr), 1;
  const auto drawn = drawTurn(argv[1], argv[2], std::atoi(argv[3]));
  if (!drawn) std::fprintf(stderr, "%s\n", drawn.error().message().c_str());
  return drawn ? 0 : 2;
}
