// What a frame with a coordinate map, or with stochastic tiling where the model has it, costs
// beside one without: three views, 512 x 512, near (a texel is larger than a pixel), and farther
// and farther away.
//
//   map_frame_bench FIELD.rf.exr [FRAMES [PATCH]]
//
// The map is 1024 x 1024, of square patches with PATCH texels a side (16).

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "PatchMap.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/HeadlessWindow.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/RenderAction.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace {

using namespace weft;

constexpr int kSide = 512;
constexpr int kSurface = 1024;

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// A square under a point light.
std::shared_ptr<Node> lit(std::shared_ptr<const Material> material) {
  auto root = std::make_shared<Node>(std::make_shared<MaterialGroup>(std::move(material)));
  root->addChild(std::make_shared<Geometry>(std::make_shared<const Mesh>(makePlane())));
  glm::mat4 shift(1.0f);
  shift[3] = glm::vec4(0.4f, 0.5f, 1.0f, 1.0f);
  root->addChild(std::make_shared<Transform>(shift))->addChild(std::make_shared<PointLight>(glm::vec3(4.0f)));
  return root;
}

// Milliseconds of a frame of each scene, in turns, so that all see the same disturbances.
Result<std::vector<std::vector<double>>> timeFrames(GLContext& context,
                                                    const std::vector<std::shared_ptr<Node>>& scenes,
                                                    int frames) {
  RenderAction renderer;
  const RenderTarget target(kSide, kSide);
  Camera camera = Camera::lookAt({0.1f, -0.25f, 0.35f}, {0, 0, 0});
  camera.verticalFieldOfView = 1.2f;
  std::vector<std::vector<double>> times(scenes.size());
  for (int frame = -2; frame < frames; ++frame)
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      WEFT_TRY_VOID(renderer.render(context, *scenes[i], camera, target));
      glFinish();
      if (frame >= 0) times[i].push_back(millisecondsSince(start));
    }
  for (std::vector<double>& of : times) std::ranges::sort(of);
  return times;
}

Result<void> measure(const char* file, int frames, int patch) {
  WEFT_TRY(const ReflectanceField field, readReflectanceField(file));
  WEFT_TRY(const auto textures, BTFTextures::create(field));
  const auto start = std::chrono::steady_clock::now();
  WEFT_TRY(const auto map,
           BTFMap::create(test::patchMap(glm::ivec2(kSurface), {field.width(), field.height()}, patch),
                          *textures, [&] { return Result<ReflectanceField>(field); }));
  fmt::print("a map of {0} x {0} texels is packed in {1:.0f} ms\n", kSurface, millisecondsSince(start));
  WEFT_TRY(const auto window, HeadlessWindow::create());
  for (const TexelFilter filter : {TexelFilter::Nearest, TexelFilter::Bilinear})
    for (const float texels : {256.0f, 1024.0f, 4096.0f, 16384.0f}) {
      const float scale = texels / static_cast<float>(field.width());
      WEFT_TRY(const auto plain,
               BTFMaterial::create(textures, {.textureScale = glm::vec2(scale), .filter = filter}));
      WEFT_TRY(const auto mapped, BTFMaterial::create(textures, {.textureScale = glm::vec2(texels / kSurface),
                                                                 .filter = filter}));
      WEFT_TRY_VOID(mapped->setMap(map));
      std::vector<std::shared_ptr<Node>> scenes;
      scenes.push_back(lit(plain));
      scenes.push_back(lit(mapped));
      if (textures->tilesAtRandom()) {
        WEFT_TRY(auto random, BTFMaterial::create(textures, {.textureScale = glm::vec2(scale),
                                                             .filter = filter,
                                                             .tiling = Tiling::Stochastic}));
        scenes.push_back(lit(std::move(random)));
      }
      WEFT_TRY(const auto times, timeFrames(window->context(), scenes, frames));
      const auto median = [&](int i) { return times[static_cast<std::size_t>(i)][times[0].size() / 2]; };
      fmt::print("{:8}, {:5} texels across: without a map {:6.2f} ms, with one {:6.2f} ms: {:.2f} times\n",
                 filter == TexelFilter::Nearest ? "nearest" : "bilinear", texels, median(0), median(1),
                 median(1) / median(0));
      if (times.size() > 2)
        fmt::print("{:40} tiled at random {:6.2f} ms: {:.2f} times\n", "", median(2), median(2) / median(0));
    }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "map_frame_bench FIELD.rf.exr [FRAMES [PATCH]]\n");
    return 1;
  }
  const auto done = measure(argv[1], argc > 2 ? std::max(std::atoi(argv[2]), 1) : 20,
                            argc > 3 ? std::max(std::atoi(argv[3]), 1) : 16);
  if (!done) fmt::print(stderr, "{}\n", done.error().message());
  return done ? 0 : 2;
}
