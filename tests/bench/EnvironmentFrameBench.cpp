// What a frame under an environment costs beside one under a point light: three views, two lobes,
// 512 x 512. And what comes before: prefiltering, and loading that from the cache.
//
//   environment_frame_bench WOOL.rf.exr [FRAMES]

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "weft/io/EnvironmentFile.h"
#include "weft/materials/LightFromEnvironment.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace {

using namespace weft;

struct Setting {
  const char* name;
  std::shared_ptr<Node> scene;
  std::vector<double> milliseconds{};
};

std::shared_ptr<Node> lit(const std::shared_ptr<const Material>& material,
                          std::shared_ptr<const NodeCore> light, glm::vec3 place) {
  auto root = std::make_shared<Node>(std::make_shared<MaterialGroup>(material));
  root->addChild(std::make_shared<Geometry>(std::make_shared<const Mesh>(makePlane())));
  glm::mat4 shift(1.0f);
  shift[3] = glm::vec4(place, 1.0f);
  root->addChild(std::make_shared<Transform>(shift))->addChild(std::move(light));
  return root;
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Prefilters into a folder of its own, and loads from there.
PrefilteredEnvironment prefilteredTwice(const Environment& environment) {
  std::string folder = (std::filesystem::temp_directory_path() / "environment-XXXXXX").string();
  const bool made = mkdtemp(folder.data()) != nullptr;
  const auto start = std::chrono::steady_clock::now();
  PrefilteredEnvironment prefiltered = PrefilteredEnvironment::create(environment);
  fmt::print("prefiltering {} x {} pixels: {:.0f} ms\n", environment.width(), environment.height(),
             millisecondsSince(start));
  if (made) {
    std::vector<std::string> warnings;
    prefilter(environment, folder, warnings);  // fills the cache
    const auto startOfLoading = std::chrono::steady_clock::now();
    prefiltered = prefilter(environment, folder, warnings);
    fmt::print("from the cache: {:.0f} ms\n", millisecondsSince(startOfLoading));
    std::filesystem::remove_all(folder);
  }
  return prefiltered;
}

Result<void> measure(const char* file, int frames) {
  WEFT_TRY(const auto material, loadBTFMaterial(file, {.textureScale = glm::vec2(4)}));
  WEFT_TRY(const Environment environment, Environment::builtin("sky"));
  const PrefilteredEnvironment prefiltered = prefilteredTwice(environment);
  WEFT_TRY(const auto prepared,
           loadBTFMaterial(file, {.textureScale = glm::vec2(4), .preparedForEnvironments = true}));
  const auto around = [&](const std::shared_ptr<const Material>& dress, LobeLookup lookup) {
    auto light = makeEnvironmentLight(environment, prefiltered, lookup);
    light->showsBackground = false;  // the square fills the picture
    return lit(dress, std::move(light), {});
  };
  std::vector<Setting> settings{
      {"point light", lit(material, std::make_shared<PointLight>(glm::vec3(4.0f)), {0.4f, 0.5f, 1.0f})},
      {"environment, prepared", around(prepared, LobeLookup::Fitted)},
      {"environment, fitted", around(material, LobeLookup::Fitted)},
      {"environment, paper", around(material, LobeLookup::Paper)}};

  WEFT_TRY(const auto window, HeadlessWindow::create());
  RenderAction renderer;
  const RenderTarget target(512, 512);
  Camera camera = Camera::lookAt({0.1f, -0.25f, 0.35f}, {0, 0, 0});
  camera.verticalFieldOfView = 1.2f;
  // one after the other, so that all see the same disturbances
  for (int frame = -2; frame < frames; ++frame)
    for (Setting& setting : settings) {
      const auto start = std::chrono::steady_clock::now();
      WEFT_TRY_VOID(renderer.render(window->context(), *setting.scene, camera, target));
      glFinish();
      if (frame >= 0) setting.milliseconds.push_back(millisecondsSince(start));
    }
  double first = 0.0;
  for (Setting& setting : settings) {
    std::ranges::sort(setting.milliseconds);
    const double median = setting.milliseconds[setting.milliseconds.size() / 2];
    if (first == 0.0) first = median;
    fmt::print("{:21} median {:6.2f} ms, least {:6.2f} ms, {:.2f} times a point light\n", setting.name,
               median, setting.milliseconds.front(), median / first);
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "environment_frame_bench FIELD.rf.exr [FRAMES]\n");
    return 1;
  }
  const auto done = measure(argv[1], argc > 2 ? std::max(std::atoi(argv[2]), 1) : 40);
  if (!done) fmt::print(stderr, "{}\n", done.error().message());
  return done ? 0 : 2;
}
