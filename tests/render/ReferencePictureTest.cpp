#include <cmath>
#include <glm/geometric.hpp>

#include "GlTest.h"
#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/baking/ReferenceRenderer.h"
#include "weft/core/ImageComparison.h"
#include "weft/fitter/FieldFit.h"
#include "weft/io/ExrFile.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

// The same scene by GL and by ray tracing: two programs that share the model's formula and nothing
// else.

namespace weft::test {
namespace {

using ReferencePicture = GlTest;

// Every texel, view and light another value.
std::shared_ptr<const ReflectanceField> unevenField() {
  const MemoryBtf source(8, 4, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    const float relief = 1.0f + 0.4f * std::sin(0.8f * static_cast<float>(x) + 2.0f * l.x) *
                                    std::cos(0.5f * static_cast<float>(y) + l.y);
    return l.z * glm::vec3(0.5f + 0.2f * v.x, 0.3f, 0.2f - 0.1f * v.y) * relief;
  });
  FitOptions options;
  options.model.name = "rfp";
  return std::make_shared<const ReflectanceField>(valueOf(fitReflectanceField(source, options)).field);
}

ReferenceMesh forReference(const Mesh& mesh) {
  return {mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords, mesh.indices};
}

TEST_F(ReferencePicture, TheReferenceRendererDrawsWhatGlDraws) {
  const auto field = unevenField();
  const auto mesh = std::make_shared<const Mesh>(makeSphere(24));
  const glm::vec3 lux(2, 1.5f, 1), candela(4, 6, 8), place(1.5f, -1, 2);

  Node scene;
  scene.addChild(dressed(
      valueOf(BTFMaterial::create(field, {.textureScale = {3, 2}, .filter = TexelFilter::Nearest})), mesh));
  scene.addChild(std::make_shared<DirectionalLight>(lux));  // along -Z, towards +Z
  glm::mat4 shift(1.0f);
  shift[3] = glm::vec4(place, 1);
  scene.addChild(std::make_shared<Transform>(shift))->addChild(std::make_shared<PointLight>(candela));
  const RenderTarget target(160, 120, Precision::Float);
  Camera camera = Camera::lookAt({1, 2, 3}, {0.1f, 0, 0});
  ASSERT_TRUE(renderer.render(context(), scene, camera, target));
  const FloatImage drawn = target.read(context());

  ReferenceShot shot;
  shot.eye = {1, 2, 3};
  shot.target = {0.1f, 0, 0};
  shot.verticalFieldOfView = camera.verticalFieldOfView;
  shot.lights = {{ReferenceLight::Kind::Directional, {0, 0, 1}, lux},
                 {ReferenceLight::Kind::Point, place, candela}};
  shot.shadows = false;
  shot.width = 160;
  shot.height = 120;
  shot.samples = 1;
  FloatImage traced =
      valueOf(ReferenceRenderer::create(forReference(*mesh)))
          .render(
              shot,
              {field->width(), field->height(), {3, 2}, [&](int x, int y, glm::vec3 light, glm::vec3 view) {
                 return field->evaluate(x, y, light, view);
               }});

  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) traced.at(x, y, 3) = 1.0f;  // GL's background is opaque

  // Pixels on an edge of the mesh or of a texel may fall to either side, and a texel of the cube
  // map that straddles two triangles of views is decided by its centre.
  const ImageComparison comparison = compareImages(drawn, traced, 1e-3f);
  EXPECT_LE(comparison.failingShare, 0.01);
  EXPECT_LE(comparison.mean, 1e-4);
  if (HasFailure()) {
    const auto folder = testFolder();
    (void)writeExr(folder / "drawn.exr", drawn);
    (void)writeExr(folder / "traced.exr", traced);
    ADD_FAILURE() << "pictures are kept in " << folder;
  }
}

}  // namespace
}  // namespace weft::test
