// Whether a fit flickers: a camera goes around a draped cloth under an environment in small steps,
// and pictures of the fit change from frame to frame beside pictures of the measurement itself.
//
//   environment_turntable UBO_WOOL64.zip ENVIRONMENT... (files, or studio, sky)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "EnvironmentReference.h"
#include "weft/baking/ReferenceRenderer.h"
#include "weft/core/Color.h"
#include "weft/evaluation/RawBtf.h"
#include "weft/fitter/FieldFit.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/scenegraph/Shapes.h"

namespace {

using namespace weft;

constexpr int kSize = 64;
constexpr int kTexels = 16;  // a side of the crop
constexpr int kFrames = 31;
constexpr float kStep = 1.0f;  // degrees
// Of the environment; sums over all of its texels are what takes time.
constexpr int kColumns = 48;
constexpr int kRows = 24;

using Shown = std::function<glm::vec3(int x, int y, const glm::mat3& axes, glm::vec3 view)>;

FloatImage frameAt(const ReferenceRenderer& renderer, float degrees, const Shown& shown) {
  ReferenceShot shot;
  const float angle = glm::radians(degrees);
  shot.eye = {3.2f * std::sin(angle), 1.8f, 3.2f * std::cos(angle)};
  shot.target = {0.0f, -0.2f, 0.0f};
  shot.width = shot.height = kSize;
  shot.samples = 2;
  ReferenceMaterial material{kTexels, kTexels, glm::vec2(8)};
  material.surroundings = shown;
  return renderer.render(shot, material);
}

/// The mean change of a pixel's displayed luminance between neighbouring frames; of the neighbours
/// that differ most.
double largestChange(const ReferenceRenderer& renderer, const Shown& shown) {
  const auto displayed = [](const FloatImage& image, int x, int y) {
    const auto rgb = image.texel(x, y);
    return encode(Encoding::Srgb, std::min(luminance({rgb[0], rgb[1], rgb[2]}), 1.0f));
  };
  double largest = 0.0;
  FloatImage before = frameAt(renderer, 0.0f, shown);
  for (int frame = 1; frame < kFrames; ++frame) {
    FloatImage after = frameAt(renderer, kStep * static_cast<float>(frame), shown);
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        sum += std::abs(double{displayed(after, x, y)} - double{displayed(before, x, y)});
    largest = std::max(largest, sum / (kSize * kSize));
    before = std::move(after);
  }
  return largest;
}

Result<void> compare(const RawBtf& raw, const std::vector<std::pair<std::string, ReflectanceField>>& fields,
                     const ReferenceRenderer& renderer, const std::string& name) {
  std::vector<std::string> warnings;
  WEFT_TRY(const Environment environment, environmentNamed(name, warnings));
  const EnvironmentReference reference(environment.reduced(kColumns, kRows));
  const double measured = largestChange(renderer, [&](int x, int y, const glm::mat3& axes, glm::vec3 view) {
    return reference.shown(axes, [&](glm::vec3 light) { return raw.evaluate(x, y, light, view); });
  });
  for (const auto& [model, field] : fields) {
    const double change = largestChange(renderer, [&](int x, int y, const glm::mat3& axes, glm::vec3 view) {
      return field.underEnvironment(x, y, view,
                                    EnvironmentReference::Light(reference, axes, LobeMethod::Fitted));
    });
    fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.2f} |\n", name, model, change, measured, change / measured);
  }
  return {};
}

Result<void> turn(int argc, char** argv) {
  WEFT_TRY(const auto source, openBtf(argv[1]));
  WEFT_TRY(const RawBtf raw, RawBtf::read(*source, Crop{20, 20, kTexels, kTexels}));
  std::vector<std::pair<std::string, ReflectanceField>> fields;
  for (const ModelDescription& model :
       {ModelDescription{.name = "rfnl", .options = {{"lobes", 2}}}, ModelDescription{.name = "rfp"}}) {
    FitOptions options;
    options.model = model;
    WEFT_TRY(FitResult fit, fitReflectanceField(raw, options));
    fields.emplace_back(model.name, std::move(fit.field));
  }
  const Mesh mesh = makeDrapedCloth();
  WEFT_TRY(
      const ReferenceRenderer renderer,
      ReferenceRenderer::create({mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords, mesh.indices}));
  fmt::print(
      "| environment | model | largest change | of the measurement | ratio |\n| --- | --- | --- | --- | --- "
      "|\n");
  for (int i = 2; i < argc; ++i) WEFT_TRY_VOID(compare(raw, fields, renderer, argv[i]));
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "environment_turntable MEASUREMENT ENVIRONMENT...\n");
    return 1;
  }
  const auto done = turn(argc, argv);
  if (!done) fmt::print(stderr, "{}\n", done.error().message());
  return done ? 0 : 2;
}
