#include "WeftScene.h"

#include <fmt/format.h>

#include <numbers>

#include "weft/core/Contract.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Transform.h"

namespace weft::bench {
namespace {

class WeftScene : public Side {
 public:
  explicit WeftScene(const SceneGrid& grid) {
    auto created = HeadlessWindow::create();
    WEFT_EXPECT(created, "a context can be made");
    window_ = std::move(*created);

    std::vector<std::shared_ptr<Geometry>> geometries;
    for (const auto& mesh : grid.meshes) geometries.push_back(std::make_shared<Geometry>(mesh));
    std::vector<std::shared_ptr<MaterialGroup>> materials;
    for (const auto& image : grid.images)
      materials.push_back(std::make_shared<MaterialGroup>(
          std::make_shared<LambertMaterial>(LambertOptions{.baseColorTexture = image})));
    for (const SceneGrid::Item& item : grid.items)
      root_.addChild(std::make_shared<Transform>(item.place))
          ->addChild(materials[item.material])
          ->addChild(geometries[item.mesh]);
    const glm::mat4 towardsLight =
        glm::inverse(glm::lookAt(SceneGrid::kTowardsLight, glm::vec3(0.0f), glm::vec3(0, 1, 0)));
    root_.addChild(std::make_shared<Transform>(towardsLight))
        ->addChild(std::make_shared<DirectionalLight>(glm::vec3(std::numbers::pi_v<float>)));
  }

  ~WeftScene() override { window_->makeCurrent(); }

  void makeCurrent() override { window_->makeCurrent(); }

  void look(bool all) override {
    camera_ = Camera::lookAt({0, 0, all ? SceneGrid::kDistance : SceneGrid::kNearDistance}, {0, 0, 0});
    camera_.verticalFieldOfView = SceneGrid::kFieldOfView;
    camera_.nearPlane = 1.0f;
    camera_.farPlane = 400.0f;
  }

  FrameTime frame(bool discard) override {
    return timed(discard, [&] {
      const auto rendered = action_.render(window_->context(), root_, camera_, target_);
      WEFT_EXPECT(rendered, "the scene can be drawn");
    });
  }

  std::vector<float> picture() override {
    makeCurrent();
    frame(false);
    const FloatImage image = target_.read(window_->context());
    std::vector<float> values;
    for (int y = image.height() - 1; y >= 0; --y)
      for (int x = 0; x < image.width(); ++x)
        for (int channel = 0; channel < 3; ++channel) values.push_back(image.at(x, y, channel));
    return values;
  }

  void explain() override {
    const RenderStatistics& s = action_.statistics();
    fmt::print("  {} objects, {} culled, {} triangles, {} draws in {} draw calls, {} state changes\n",
               s.objects, s.culled, s.triangles, s.draws, s.drawCalls, s.stateChanges);
  }

 private:
  std::unique_ptr<HeadlessWindow> window_;
  Node root_;
  Camera camera_;
  RenderTarget target_{SceneGrid::kPicture, SceneGrid::kPicture};
  RenderAction action_;
};

}  // namespace

std::unique_ptr<Side> makeWeftScene(const SceneGrid& grid) {
  return std::make_unique<WeftScene>(grid);
}

}  // namespace weft::bench
