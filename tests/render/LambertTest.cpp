#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "GlTest.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Renderer.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A square from -1 to 1 in the plane z = 0, facing +Z, image upright.
std::shared_ptr<const Mesh> square() {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh->normals.assign(4, {0, 0, 1});
  mesh->tangents.assign(4, {1, 0, 0, 1});
  mesh->texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh->indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// From +Z at the origin; the square fills the picture.
Camera camera() {
  Camera camera = Camera::lookAt({0, 0, 2}, {0, 0, 0});
  camera.verticalFieldOfView = 2.0f * std::atan(0.5f);
  return camera;
}

class LambertTest : public test::GlTest {
 protected:
  FloatImage render(const Node& root, int width = 8, int height = 8) {
    const RenderTarget target(width, height, Precision::Float);
    const auto rendered = renderer_.render(context(), root, camera(), target);
    EXPECT_TRUE(rendered) << (rendered ? "" : rendered.error().message());
    return target.read(context());
  }

  Renderer renderer_;
};

std::shared_ptr<Node> litSquare(const LambertOptions& options, std::shared_ptr<const NodeCore> light) {
  auto root = std::make_shared<Node>();
  root->addChild(std::move(light));
  root->addChild(std::make_shared<MaterialGroup>(std::make_shared<LambertMaterial>(options)))
      ->addChild(std::make_shared<Geometry>(square()));
  return root;
}

TEST_F(LambertTest, WhiteFacingIrradiancePiShowsOne) {
  const auto root = litSquare({}, std::make_shared<DirectionalLight>(glm::vec3(kPi)));
  const FloatImage picture = render(*root);
  for (const float value : picture.values()) EXPECT_NEAR(value, 1.0f, 1e-3f);
}

}  // namespace
}  // namespace weft
