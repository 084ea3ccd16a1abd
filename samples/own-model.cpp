// A reflectance model of one's own, fitted and drawn: own-model UBO_WOOL64.zip own.rf.exr own.png
#include <algorithm>
#include <array>
#include <cstdio>

#include "weft/fitter/FieldFit.h"
#include "weft/fitter/LinearFitter.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"

// For every view, and at every texel, max(0, a0 + a1 lx + a2 ly + a3 lz) times the base colour.
class SlopeModel : public weft::ReflectanceModel {
 public:
  using ReflectanceModel::ReflectanceModel;

  std::vector<std::string> layerParameters() const override { return {"a0", "a1", "a2", "a3"}; }

  float evaluate(std::span<const float>, std::span<const float> a, glm::vec3 light,
                 glm::vec3) const override {
    return std::max(a[0] + a[1] * light.x + a[2] * light.y + a[3] * light.z, 0.0f);
  }

  // What evaluate() says, for the GPU; a view's four numbers fill one texel.
  std::string shaderFile() const override { return "slope.glsl"; }
  std::string shaderText() const override {
    return R"(
float evaluateModel(SharedParameters shared_, LayerParameters layer, vec3 light, vec3 view) {
  return diffusePart * max(dot(layer.texels[0], vec4(1, light)), 0.0);
})";
  }
};

weft::ModelRegistry models() {
  weft::ModelRegistry models = weft::ModelRegistry::builtin();
  const auto make = [](weft::ModelOptions options) {
    return std::make_shared<const SlopeModel>(std::move(options));
  };
  models.add({"slope", "A linear function of the light for every view.", {}, make});
  return models;
}

// The value is a sum of terms times numbers: least squares find these, and Weft has them.
weft::Result<std::unique_ptr<weft::TexelFitter>> makeSlopeFitter(const weft::FitProblem& problem) {
  return weft::LinearFitter::create(problem, [](glm::vec3 light, std::span<double> terms) {
    std::ranges::copy(std::array{1.0f, light.x, light.y, light.z}, terms.begin());
  });
}

weft::Result<void> fit(const char* measurement, const char* field) {
  WEFT_TRY(const auto source, weft::openBtf(measurement));
  weft::FitOptions options;
  options.model.name = "slope";
  options.models = models();
  options.fitters.add("slope", makeSlopeFitter);
  WEFT_TRY(const weft::FitResult result, weft::fitReflectanceField(*source, options));
  std::fputs(weft::toText("eps", result.errors).c_str(), stdout);
  return weft::writeReflectanceField(result.field, field);
}

weft::Result<void> draw(const char* field, const char* picture) {
  WEFT_TRY(const auto window, weft::HeadlessWindow::create());
  WEFT_TRY(const auto material,
           weft::loadBTFMaterial(field, {.textureScale = glm::vec2(12), .doubleSided = true}, models()));
  weft::Node scene(std::make_shared<weft::MaterialGroup>(material));
  scene.addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeDrapedCloth())));
  scene.addChild(std::make_shared<weft::DirectionalLight>(glm::vec3(3)));
  const weft::Camera camera = weft::frame(scene, {1, 1, 2}, 4.0f / 3.0f);
  const weft::RenderTarget target(960, 720);
  WEFT_TRY_VOID(weft::RenderAction().render(window->context(), scene, camera, target));
  return weft::writePng(picture, target.read(window->context(), 2));
}

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: own-model MEASUREMENT NAME.rf.exr PICTURE.png\n", stderr), 1;
  auto done = fit(argv[1], argv[2]);
  if (done) done = draw(argv[2], argv[3]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 2;
}
