// What a lobe of gloss does for directions that were not fitted: errors of `rfnl`, `loom` and
// `loom_gloss` over pairs that are held out.
//
//   gloss_table INPUT|SURFACE:ALPHA...
//
// A surface is one of weft-bake's patterns, or ggx, which has normals but no relief; alpha is that
// of its highlights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "BakedSource.h"
#include "MemoryBtf.h"
#include "weft/baking/Pattern.h"
#include "weft/core/Color.h"
#include "weft/evaluation/HoldOut.h"
#include "weft/fitter/FieldFit.h"
#include "weft/fitter/GlossChoice.h"

namespace {

using namespace weft;

constexpr int kLights = 8, kViews = 10;  // about every nth is held out
constexpr int kEveryTexel = 7;
constexpr std::size_t kBrightest = 50;  // one in so many

/// Luminance of a pair that was not fitted.
struct Pair {
  float measured, model;
};

float shown(float value) {
  return encode(Encoding::Gamma22, glm::vec3(std::max(value, 0.0f))).x;
}

double errorOf(std::span<const Pair> pairs) {
  double sum = 0.0;
  for (const Pair& pair : pairs) sum += std::abs(shown(pair.model) - shown(pair.measured));
  return sum / static_cast<double>(pairs.size());
}

double shareOf(std::span<const Pair> pairs) {
  double measured = 0.0, model = 0.0;
  for (const Pair& pair : pairs) measured += pair.measured, model += pair.model;
  return model / measured;
}

// Lambert and GGX on normals that lean up to 25 degrees; without shadows.
glm::vec3 madeUp(float alpha, int x, int y, glm::vec3 v, glm::vec3 l) {
  const float phase = 0.7f * static_cast<float>(x) + 1.9f * static_cast<float>(y);
  const glm::vec3 n = glm::normalize(glm::vec3(
      0.45f * std::sin(phase), 0.45f * std::cos(1.7f * phase + 0.4f * static_cast<float>(y)), 1.0f));
  const float nl = glm::dot(n, l), nv = std::max(glm::dot(n, v), 1e-3f), squared = alpha * alpha;
  if (nl <= 0.0f) return glm::vec3(0.0f);
  const float nh = glm::dot(n, glm::normalize(l + v)), width = 1.0f - nh * nh * (1.0f - squared);
  const float shadowing = nl * std::sqrt(nv * nv * (1.0f - squared) + squared) +
                          nv * std::sqrt(nl * nl * (1.0f - squared) + squared);
  const float gloss = 0.04f * squared / (width * width) * 0.5f / shadowing;
  return nl * (glm::vec3(0.25f, 0.15f, 0.1f) * (1.0f + 0.3f * std::sin(phase)) + gloss);
}

Result<std::unique_ptr<BtfSource>> open(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  if (colon == std::string::npos) return openBtf(name);
  const float alpha = std::strtof(name.c_str() + colon + 1, nullptr);
  if (!name.starts_with("ggx:")) {
    constexpr int kSide = 48;
    WEFT_TRY(HeightField field, makePattern(name.substr(0, colon), 6 * kSide));
    for (HeightField::Sample& sample : field.samples) sample.roughness = alpha;
    return std::make_unique<test::BakedSource>(field, BakeOptions{.width = kSide, .height = kSide});
  }
  return std::make_unique<test::MemoryBtf>(
      32, 32, [alpha](int x, int y, glm::vec3 v, glm::vec3 l) { return madeUp(alpha, x, y, v, l); });
}

Result<std::vector<Pair>> heldOutPairs(const ReflectanceField& field, const BtfSource& source) {
  const BtfDescription& measured = source.description();
  const std::vector<bool> views = heldOut(measured.views, kViews), lights = heldOut(measured.lights, kLights);
  std::vector<glm::vec3> samples(views.size() * lights.size());
  std::vector<Pair> pairs;
  SampleRows rows;
  WEFT_TRY_VOID(source.readRows(0, measured.height, rows));
  for (int texel = 0; texel < measured.width * measured.height; texel += kEveryTexel) {
    const int x = texel % measured.width, y = texel / measured.width;
    rows.linear(y, x, samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t view = i / lights.size(), light = i % lights.size();
      if (views[view] || lights[light])
        pairs.push_back({luminance(samples[i]),
                         luminance(field.evaluate(x, y, measured.lights[light], measured.views[view]))});
    }
  }
  return pairs;
}

Result<void> printRow(const BtfSource& source, const ModelDescription& model) {
  FitOptions options;
  options.model = model;
  options.holdOutLights = kLights;
  options.holdOutViews = kViews;
  WEFT_TRY(const FitResult fit, fitReflectanceField(source, options));
  WEFT_TRY(std::vector<Pair> pairs, heldOutPairs(fit.field, source));
  const std::size_t count = pairs.size() / kBrightest;
  std::ranges::nth_element(pairs, pairs.begin() + static_cast<std::ptrdiff_t>(count), std::greater(),
                           &Pair::measured);
  const std::span<const Pair> brightest(pairs.data(), count);
  fmt::print("  {:<11} {:.4f}  {:.4f}    {:.4f}     {:.2f}     {:.1f}\n", model.name,
             fit.errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance).average, errorOf(pairs),
             errorOf(brightest), shareOf(brightest), fit.secondsFitting);
  return {};
}

Result<void> printTable(const std::string& name) {
  WEFT_TRY(const std::unique_ptr<BtfSource> source, open(name));
  WEFT_TRY(const GlossChoice choice, chooseGloss(*source, {}));
  fmt::print("{}: {}, {}\n  model       fitted  held out  brightest  light kept  s\n", name,
             choice.isTaken ? "a lobe" : "no lobe", choice.reason);
  const std::vector<ModelDescription> models = {
      {"rfnl", {{"rho_d", "per-view"}}}, {"loom", {}}, {"loom_gloss", {}}};
  for (const ModelDescription& model : models) WEFT_TRY_VOID(printRow(*source, model));
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (const auto printed = printTable(argv[i]); !printed)
      return fmt::print(stderr, "{}\n", printed.error().message()), 2;
  return 0;
}
