#include "weft/fitter/GlossChoice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solvers/GlossSolver.h"
#include "weft/core/BatchEncoding.h"
#include "weft/core/Color.h"
#include "weft/core/HemisphereTriangulation.h"
#include "weft/evaluation/HoldOut.h"
#include "weft/evaluation/RawBtf.h"

namespace weft {
namespace {

constexpr int kSide = 64;  // of the crop
constexpr std::size_t kTexels = 300;
constexpr double kBrightest = 0.02;
constexpr double kGainOfBrightest = 0.10, kGainOfAll = 0.05;
constexpr double kLeastGain = 0.001;  // a quarter of a step of a byte

/// The fitted ones of some directions, and each of all between them.
struct SplitDirections {
  std::vector<bool> isFitted;
  std::vector<glm::vec3> fitted;
  std::vector<DirectionWeights> between;
};

Result<SplitDirections> splitDirections(const std::vector<glm::vec3>& all, int every) {
  SplitDirections split{heldOut(all, every), {}, {}};
  split.isFitted.flip();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].z <= 0.0f) split.isFitted[i] = false;
    if (split.isFitted[i]) split.fitted.push_back(all[i]);
  }
  WEFT_TRY(const auto triangulation, HemisphereTriangulation::create(split.fitted));
  for (const glm::vec3 direction : all) split.between.push_back(triangulation.locate(direction));
  return split;
}

/// Of a held-out pair of a texel, as a display shows them.
struct GlossErrors {
  float value, without, with;
};

/// A few texels in memory, without the directions that are held out.
struct GlossTrial {
  const BtfDescription& measured;
  SplitDirections views, lights;

  std::vector<float> fittedOf(std::span<const glm::vec3> texel) const;
  float interpolated(std::size_t view, std::size_t light, std::span<const float> fitted) const;
  void addErrors(std::span<const glm::vec3> texel, std::span<const float> fitted,
                 std::span<const float> gloss, const GlossLobe& lobe, std::vector<GlossErrors>& errors) const;
};

std::vector<float> GlossTrial::fittedOf(std::span<const glm::vec3> texel) const {
  std::vector<float> fitted;
  for (std::size_t view = 0; view < measured.views.size(); ++view)
    for (std::size_t light = 0; light < measured.lights.size(); ++light)
      if (views.isFitted[view] && lights.isFitted[light])
        fitted.push_back(luminance(texel[view * measured.lights.size() + light]));
  return fitted;
}

// Lights without n.l, which is put back.
float GlossTrial::interpolated(std::size_t view, std::size_t light, std::span<const float> fitted) const {
  const DirectionWeights &v = views.between[view], &l = lights.between[light];
  float sum = 0.0f;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto index = static_cast<std::size_t>(l.index[k]);
      const std::size_t pair = static_cast<std::size_t>(v.index[i]) * lights.fitted.size() + index;
      sum += v.weight[static_cast<int>(i)] * l.weight[static_cast<int>(k)] * fitted[pair] /
             std::max(lights.fitted[index].z, 0.1f);
    }
  return sum * measured.lights[light].z;
}

void GlossTrial::addErrors(std::span<const glm::vec3> texel, std::span<const float> fitted,
                           std::span<const float> gloss, const GlossLobe& lobe,
                           std::vector<GlossErrors>& errors) const {
  const auto shown = [](float value) {
    return encode(Encoding::Gamma22, glm::vec3(std::max(value, 0.0f))).x;
  };
  for (std::size_t view = 0; view < measured.views.size(); ++view)
    for (std::size_t light = 0; light < measured.lights.size(); ++light) {
      const glm::vec3 l = measured.lights[light];
      if (l.z <= 0.0f || (views.isFitted[view] && lights.isFitted[light])) continue;
      const float value = shown(luminance(texel[view * measured.lights.size() + light]));
      const float plain = interpolated(view, light, fitted), lobes = interpolated(view, light, gloss);
      const float with = plain - lobes + l.z * lobe.evaluate(l, measured.views[view]);
      errors.push_back({value, std::abs(shown(plain) - value), std::abs(shown(with) - value)});
    }
}

Result<GlossTrial> makeTrial(const BtfDescription& measured) {
  WEFT_TRY(SplitDirections views, splitDirections(measured.views, 10));
  WEFT_TRY(SplitDirections lights, splitDirections(measured.lights, 8));
  return GlossTrial{measured, std::move(views), std::move(lights)};
}

Result<std::vector<GlossErrors>> glossErrors(const GlossTrial& trial, const RawBtf& raw) {
  const BtfDescription& measured = raw.description();
  // odd, so that rows are met at other columns each
  const std::size_t step = measured.texels() / kTexels | 1;
  std::vector<std::vector<glm::vec3>> texels;
  std::vector<float> fitted;
  for (std::size_t i = 0; i < measured.texels(); i += step) {
    std::vector<glm::vec3>& texel = texels.emplace_back(measured.views.size() * measured.lights.size());
    const int at = static_cast<int>(i);
    raw.samples().linear(at / measured.width, at % measured.width, texel);
    for (float& sample : floatsOf(std::span(texel)))
      if (!std::isfinite(sample)) sample = 0.0f;
    const std::vector<float> values = trial.fittedOf(texel);
    fitted.insert(fitted.end(), values.begin(), values.end());
  }
  const std::size_t pairs = fitted.size() / texels.size();
  std::vector<float> means(pairs);
  for (std::size_t i = 0; i < fitted.size(); ++i)
    means[i % pairs] += fitted[i] / static_cast<float>(texels.size());
  WEFT_TRY(const GlossSolver solver, GlossSolver::create(trial.views.fitted, trial.lights.fitted, means));
  const std::vector<GlossLobe> lobes = solver.solve(fitted);
  std::vector<GlossErrors> errors;
  for (std::size_t i = 0; i < texels.size(); ++i)
    trial.addErrors(texels[i], std::span(fitted).subspan(i * pairs, pairs), solver.valuesOf(lobes[i]),
                    lobes[i], errors);
  return errors;
}

// By which part the mean error falls; 0 where that is next to nothing.
double gainOf(std::span<const GlossErrors> errors) {
  double without = 0.0, with = 0.0;
  for (const GlossErrors& error : errors) {
    without += double{error.without};
    with += double{error.with};
  }
  return without - with > kLeastGain * static_cast<double>(errors.size()) ? 1.0 - with / without : 0.0;
}

Crop middleOf(const Crop& whole) {
  const int width = std::min(whole.width, kSide), height = std::min(whole.height, kSide);
  return {whole.x + (whole.width - width) / 2, whole.y + (whole.height - height) / 2, width, height};
}

}  // namespace

Result<GlossChoice> chooseGloss(const BtfSource& source, const std::optional<Crop>& crop) {
  WEFT_TRY(const Crop whole, checkedCrop(crop, source.description()));
  const Result<GlossTrial> trial = makeTrial(source.description());
  if (!trial) return GlossChoice{false, trial.error().message()};
  WEFT_TRY(const RawBtf raw, RawBtf::read(source, middleOf(whole)));
  Result<std::vector<GlossErrors>> errors = glossErrors(*trial, raw);
  if (!errors) return GlossChoice{false, errors.error().message()};
  const double ofAll = gainOf(*errors);
  const auto last =
      errors->begin() + static_cast<std::ptrdiff_t>(kBrightest * static_cast<double>(errors->size()));
  std::ranges::nth_element(*errors, last, std::greater(), &GlossErrors::value);
  const double ofBrightest = gainOf({errors->begin(), last});
  return GlossChoice{
      ofBrightest > kGainOfBrightest || ofAll > kGainOfAll,
      fmt::format("it takes {:.0f} % of the error of the brightest pairs that are held out, and "
                  "{:.1f} % of all",
                  100.0 * ofBrightest, 100.0 * ofAll)};
}

}  // namespace weft
