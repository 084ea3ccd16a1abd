// What the formulas for light from environments cost: pictures of a sphere by each of them, against
// the true integral over the same fit, and that against the measurement itself.
//
//   environment_table UBO_WOOL64.zip ENVIRONMENT... (files, or studio, sky)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
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

constexpr int kSize = 40;
constexpr int kTexels = 8;  // a side of the crop
constexpr int kColumns = 96;
constexpr int kRows = 48;

using Shown = std::function<glm::vec3(int x, int y, const glm::mat3& axes, glm::vec3 view)>;

Result<FloatImage> sphere(const Shown& shown) {
  const Mesh mesh = makeSphere(32);
  WEFT_TRY(
      const ReferenceRenderer renderer,
      ReferenceRenderer::create({mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords, mesh.indices}));
  ReferenceShot shot;
  shot.eye = {0.3f, 1.0f, 2.8f};
  shot.width = shot.height = kSize;
  shot.samples = 1;
  ReferenceMaterial material{kTexels, kTexels, glm::vec2(8)};
  material.surroundings = shown;
  return renderer.render(shot, material);
}

struct Difference {
  double mean = 0.0, maximum = 0.0;
};

float luminanceOf(const FloatImage& image, int x, int y) {
  const auto rgb = image.texel(x, y);
  return luminance({rgb[0], rgb[1], rgb[2]});
}

/// Of luminance, relative to max(reference, 5 % of the picture's mean).
Difference difference(const FloatImage& actual, const FloatImage& expected) {
  double sum = 0.0;
  int count = 0;
  const auto forAll = [&](const auto& visit) {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        if (expected.at(x, y, 3) > 0.0f) visit(luminanceOf(actual, x, y), luminanceOf(expected, x, y));
  };
  forAll([&](float, float reference) { sum += reference, ++count; });
  const double floor = 0.05 * sum / count;
  Difference result;
  forAll([&](float value, float reference) {
    const double relative = std::abs(value - reference) / std::max<double>(reference, floor);
    result.mean += relative / count;
    result.maximum = std::max(result.maximum, relative);
  });
  return result;
}

void print(const std::string& model, const std::string& formula, const Difference& found) {
  fmt::print("| {:6} | {:34} | {:6.2f} | {:7.1f} |\n", model, formula, 100.0 * found.mean,
             100.0 * found.maximum);
}

/// The true integral of a fit, times n.l.
FloatImage trueIntegral(const EnvironmentReference& reference, const ReflectanceField& field) {
  return *sphere([&](int x, int y, const glm::mat3& axes, glm::vec3 view) {
    const DirectionWeights layers = field.formula().layersAround({0, 0, 1}, view);
    return reference.shown(axes, [&](glm::vec3 light) { return field.evaluate(x, y, layers, light, view); });
  });
}

FloatImage byFormula(const EnvironmentReference& reference, const ReflectanceField& field,
                     LobeMethod method) {
  return *sphere([&](int x, int y, const glm::mat3& axes, glm::vec3 view) {
    return field.underEnvironment(x, y, view, EnvironmentReference::Light(reference, axes, method));
  });
}

Result<void> compare(const RawBtf& raw, const std::vector<std::pair<std::string, ReflectanceField>>& fields,
                     const std::string& name) {
  std::vector<std::string> warnings;
  WEFT_TRY(const Environment environment, environmentNamed(name, warnings));
  const EnvironmentReference reference(environment.reduced(kColumns, kRows));
  WEFT_TRY(const FloatImage measured, sphere([&](int x, int y, const glm::mat3& axes, glm::vec3 view) {
             return reference.shown(axes, [&](glm::vec3 light) { return raw.evaluate(x, y, light, view); });
           }));
  fmt::print(
      "\n{}\n\n| model  | formula                            | mean % | maximum % |\n| --- | --- | --- | --- "
      "|\n",
      name);
  for (const auto& [model, field] : fields) {
    const FloatImage exact = trueIntegral(reference, field);
    print(model, "true integral, against measurement", difference(exact, measured));
    const bool lobes = model != "rfp" && model != "bump" && model != "lfnl";
    const std::vector<std::pair<const char*, LobeMethod>> methods{
        {"paper", LobeMethod::Paper},
        {"paper, rounded exponents", LobeMethod::PaperRounded},
        {"shifted", LobeMethod::Shifted},
        {"fitted", LobeMethod::Fitted}};
    for (const auto& [formula, method] : methods) {
      if (!lobes && method != LobeMethod::Fitted) continue;
      const FloatImage approximated = byFormula(reference, field, method);
      print(model, std::string(lobes ? formula : "its formula"), difference(approximated, exact));
      if (method == LobeMethod::Fitted || method == LobeMethod::PaperRounded)
        print(model, std::string(lobes ? formula : "its formula") + ", against measurement",
              difference(approximated, measured));
    }
  }
  return {};
}

Result<void> table(int argc, char** argv) {
  WEFT_TRY(const auto source, openBtf(argv[1]));
  WEFT_TRY(const RawBtf raw, RawBtf::read(*source, Crop{20, 20, kTexels, kTexels}));
  std::vector<std::pair<std::string, ReflectanceField>> fields;
  for (const ModelDescription& model :
       {ModelDescription{.name = "rfnl", .options = {{"lobes", 2}}}, ModelDescription{.name = "rfp"},
        ModelDescription{.name = "laf", .options = {{"lobes", 4}}},
        ModelDescription{.name = "slaf", .options = {{"lobes", 4}}}, ModelDescription{.name = "bump"},
        ModelDescription{.name = "lfnl", .options = {{"lobes", 2}}}}) {
    FitOptions options;
    options.model = model;
    WEFT_TRY(FitResult fit, fitReflectanceField(raw, options));
    fields.emplace_back(model.name, std::move(fit.field));
  }
  for (int i = 2; i < argc; ++i) WEFT_TRY_VOID(compare(raw, fields, argv[i]));
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "environment_table MEASUREMENT ENVIRONMENT...\n");
    return 1;
  }
  const auto done = table(argc, argv);
  if (!done) fmt::print(stderr, "{}\n", done.error().message());
  return done ? 0 : 2;
}
