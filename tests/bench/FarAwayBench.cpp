// What is left of a material far away: pictures that GL draws, with coarser levels and without,
// beside those that 256 rays a pixel see of the measurement itself, and beside 64 samples a pixel
// of the field's own finest texels, which is what levels are to come close to.
//
//   far_away_bench INPUT FIELD.rf.exr... [FOLDER/]
//
// FOLDER gets a picture a scene: the reference, then each field without levels and with them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <vector>

#include "weft/baking/ReferenceRenderer.h"
#include "weft/core/Color.h"
#include "weft/evaluation/RawBtf.h"
#include "weft/io/ImageFile.h"
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

constexpr int kSize = 192;
constexpr int kTurnSize = 96;
constexpr int kTurnFrames = 9;
constexpr float kTurnStep = 0.5f;  // degrees
constexpr float kUvScale = 5.0f;   // of the cloth at distance 1: a texel is about a pixel
const glm::vec3 kTowardsLight = glm::normalize(glm::vec3(-3, 3, 2));

/// A field as it is drawn, or the same without coarser levels.
struct Drawn {
  std::string name;
  std::shared_ptr<const BTFTextures> textures;
  std::shared_ptr<const BTFTextures> finest;
};

struct Scene {
  std::string name;
  const Mesh* mesh;
  const ReferenceRenderer* renderer;
  glm::vec3 eye, target, up;
  float repetitions;
  int size = kSize;
};

/// GL's, and rays'.
class Studio {
 public:
  static Result<Studio> create(const RawBtf& raw) {
    Studio studio(raw);
    WEFT_TRY(studio.window_, HeadlessWindow::create());
    return studio;
  }

  FloatImage traced(const Scene& scene, int samples) const {
    ReferenceShot shot;
    shot.eye = scene.eye, shot.target = scene.target, shot.up = scene.up;
    shot.lights = {{ReferenceLight::Kind::Directional, kTowardsLight, glm::vec3(glm::pi<float>())}};
    shot.shadows = false;
    shot.width = shot.height = scene.size;
    shot.samples = samples;
    const BtfDescription& measured = raw_->description();
    return scene.renderer->render(
        shot, {measured.width, measured.height, glm::vec2(scene.repetitions),
               [&](int x, int y, glm::vec3 l, glm::vec3 v) { return raw_->evaluate(x, y, l, v); }});
  }

  /// By `samples` x `samples` a pixel.
  Result<FloatImage> drawn(const Scene& scene, const std::shared_ptr<const BTFTextures>& textures,
                           int samples = 1) {
    WEFT_TRY(const auto material, BTFMaterial::create(textures, {.textureScale = glm::vec2(scene.repetitions),
                                                                 .doubleSided = true}));
    Node root(std::make_shared<MaterialGroup>(material));
    root.addChild(std::make_shared<Geometry>(std::make_shared<const Mesh>(*scene.mesh)));
    const glm::vec3 z = kTowardsLight, x = glm::normalize(glm::cross(glm::vec3(0, 1, 0), z));
    const glm::mat4 turned{glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), {0, 0, 0, 1}};
    root.addChild(std::make_shared<Transform>(turned))
        ->addChild(std::make_shared<DirectionalLight>(glm::vec3(glm::pi<float>())));
    Camera camera = Camera::lookAt(scene.eye, scene.target, scene.up);
    camera.nearPlane = 0.01f;
    const RenderTarget target(scene.size * samples, scene.size * samples);
    WEFT_TRY_VOID(renderer_.render(window_->context(), root, camera, target));
    return target.read(window_->context(), samples);
  }

 private:
  explicit Studio(const RawBtf& raw) : raw_(&raw) {}

  const RawBtf* raw_;
  std::unique_ptr<HeadlessWindow> window_;
  RenderAction renderer_;
};

void print(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);  // minutes lie between lines
}

glm::vec3 displayed(const FloatImage& image, int x, int y) {
  const std::span<const float> texel = image.texel(x, y);
  return encode(Encoding::Srgb, glm::min(glm::vec3(texel[0], texel[1], texel[2]), 1.0f));
}

/// The root of the mean squared `difference(x, y)` where rays met nothing but the surface.
template <class Difference>
double rootMeanSquare(const FloatImage& reference, const Difference& difference) {
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < reference.height(); ++y)
    for (int x = 0; x < reference.width(); ++x) {
      if (reference.at(x, y, 3) < 0.999f) continue;
      const glm::vec3 d = difference(x, y);
      sum += static_cast<double>(glm::dot(d, d)) / 3.0;
      count += 1.0;
    }
  return std::sqrt(sum / std::max(count, 1.0));
}

Result<void> addDrawn(const std::string& file, std::vector<Drawn>& fields) {
  WEFT_TRY(const ReflectanceField field, readReflectanceField(file));
  const std::string model = field.model().description().name;
  WEFT_TRY(const auto textures, BTFTextures::create(field));
  std::shared_ptr<const BTFTextures> ofFinest = textures;  // where levels are summed, all count
  if (field.model().summedLevels() == 0) {
    WEFT_TRY(const auto builtin, ModelRegistry::builtin().create(field.model().description()));
    WEFT_TRY(
        const ReflectanceField finest,
        ReflectanceField::create(builtin, field.description(), {field.levels().front()}, field.tables()));
    WEFT_TRY(ofFinest, BTFTextures::create(finest));
    fields.push_back({model + " without levels", ofFinest, ofFinest});
  }
  fields.push_back({model, textures, ofFinest});
  return {};
}

/// Pictures side by side.
FloatImage inARow(const std::vector<FloatImage>& pictures) {
  const int size = pictures.front().width();
  FloatImage row(size * static_cast<int>(pictures.size()), pictures.front().height(), {"R", "G", "B"});
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (int y = 0; y < row.height(); ++y)
      for (int x = 0; x < size; ++x)
        std::ranges::copy(pictures[i].texel(x, y).first(3),
                          row.texel(static_cast<int>(i) * size + x, y).begin());
  return row;
}

Result<void> compareScene(Studio& studio, const Scene& scene, const std::vector<Drawn>& fields,
                          const std::optional<std::filesystem::path>& folder) {
  std::vector<FloatImage> pictures{studio.traced(scene, 16)};
  for (const Drawn& field : fields) {
    WEFT_TRY(const FloatImage drawn, studio.drawn(scene, field.textures));
    WEFT_TRY(const FloatImage sampled, studio.drawn(scene, field.finest, 8));
    const auto errorFrom = [&](const FloatImage& wanted) {
      return rootMeanSquare(pictures.front(),
                            [&](int x, int y) { return displayed(drawn, x, y) - displayed(wanted, x, y); });
    };
    print(fmt::format("{:18} {:20} {:.4f} {:.4f}", scene.name, field.name, errorFrom(pictures.front()),
                      errorFrom(sampled)));
    pictures.push_back(drawn);
  }
  if (folder) WEFT_TRY_VOID(writePng(*folder / (scene.name + ".png"), inARow(pictures)));
  return {};
}

/// Seen from an angle around the vertical axis, in degrees.
Scene turned(Scene scene, float degrees) {
  const float angle = glm::radians(degrees);
  const glm::vec3 eye = scene.eye;
  scene.eye = {eye.x * std::cos(angle) + eye.z * std::sin(angle), eye.y,
               eye.z * std::cos(angle) - eye.x * std::sin(angle)};
  scene.size = kTurnSize;
  return scene;
}

/// How much more, or else, a picture changes from frame to frame than the measurement does.
Result<void> compareTurns(Studio& studio, const Scene& scene, const std::vector<Drawn>& fields) {
  std::vector<Scene> frames;
  std::vector<FloatImage> references;
  for (int i = 0; i < kTurnFrames; ++i) {
    frames.push_back(turned(scene, kTurnStep * static_cast<float>(i)));
    references.push_back(studio.traced(frames.back(), 12));
  }
  for (const Drawn& field : fields) {
    std::optional<FloatImage> before;
    double flicker = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      WEFT_TRY(FloatImage now, studio.drawn(frames[i], field.textures));
      if (before)
        flicker +=
            rootMeanSquare(references[i],
                           [&](int x, int y) {
                             return displayed(now, x, y) - displayed(*before, x, y) -
                                    (displayed(references[i], x, y) - displayed(references[i - 1], x, y));
                           }) /
            static_cast<double>(frames.size() - 1);
      before = std::move(now);
    }
    print(fmt::format("{:18} {:20} {:.4f}", scene.name + ", turned", field.name, flicker));
  }
  return {};
}

Result<ReferenceRenderer> rendererOf(const Mesh& mesh) {
  return ReferenceRenderer::create(
      {mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords, mesh.indices});
}

Result<void> compare(const std::vector<std::string>& arguments) {
  WEFT_TRY(const auto source, openBtf(arguments[0]));
  WEFT_TRY(const RawBtf raw, RawBtf::read(*source));
  std::vector<Drawn> fields;
  std::optional<std::filesystem::path> folder;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i].ends_with('/'))
      folder = arguments[i];
    else
      WEFT_TRY_VOID(addDrawn(arguments[i], fields));
  }
  WEFT_TRY(Studio studio, Studio::create(raw));
  const Mesh plane = makePlane(), cloth = makeDrapedCloth();
  WEFT_TRY(const ReferenceRenderer ofPlane, rendererOf(plane));
  WEFT_TRY(const ReferenceRenderer ofCloth, rendererOf(cloth));
  WEFT_TRY_VOID(compareScene(studio,
                             {"plane", &plane, &ofPlane, {0, -0.45f, 0.08f}, {0, 0.1f, 0}, {0, 0, 1}, 60.0f},
                             fields, folder));
  for (const int distance : {1, 4, 16}) {
    const Scene scene{fmt::format("cloth-{}", distance),
                      &cloth,
                      &ofCloth,
                      {1.6f, 1.4f, 2.1f},
                      {0.0f, -0.2f, 0.0f},
                      {0, 1, 0},
                      kUvScale * static_cast<float>(distance)};
    WEFT_TRY_VOID(compareScene(studio, scene, fields, folder));
    if (distance > 1) WEFT_TRY_VOID(compareTurns(studio, scene, fields));
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "far_away_bench INPUT FIELD.rf.exr... [FOLDER/]\n");
    return 1;
  }
  const auto done = compare({argv + 1, argv + argc});
  if (!done) fmt::print(stderr, "{}\n", done.error().message());
  return done ? 0 : 2;
}
