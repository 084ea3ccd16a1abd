// Table 1 and figure 6 of [Ma 2005]: eps of Y, Cb and Cr of stored values, for some numbers of
// components of Y.
//
//     lod_table INPUT [COMPONENTS...]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/common.hpp>
#include <span>
#include <vector>

#include "weft/fitter/FieldFit.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/reflectance/LodModel.h"

namespace {

using namespace weft;

/// Of Y, Cb and Cr, over texels.
struct Range {
  double sum = 0.0, smallest = INFINITY, largest = 0.0;
};

// Mean absolute differences of one texel, of Y, Cb and Cr.
glm::dvec3 errorsOf(const ReflectanceField& field, const BtfDescription& measured,
                    const ModelledLights& lights, const SampleRows& rows, int x, int y) {
  const std::size_t lightCount = measured.lights.size();
  std::vector<glm::vec3> samples(measured.views.size() * lightCount), model(lightCount);
  rows.stored(y, x, samples);
  glm::dvec3 errors(0.0);
  std::vector<float> filtered;
  for (std::size_t view = 0; view < measured.views.size(); ++view) {
    const glm::vec3 direction = measured.views[view];
    const auto shared = field.sharedSeenAt(x, y, direction, filtered);
    field.formula().evaluateLights(shared, {}, static_cast<int>(view), lights, direction, model);
    for (std::size_t light = 0; light < lightCount; ++light) {
      const glm::vec3 stored = encode(measured.encoding, model[light]);
      errors += glm::dvec3(glm::abs(yCbCrFromRgb(stored - samples[view * lightCount + light])));
    }
  }
  return errors / static_cast<double>(samples.size());
}

Result<void> printRow(const BtfSource& source, int components) {
  FitOptions options;
  options.model = {"lod", {{"components", components}}};
  options.space = FitSpace::Stored;
  WEFT_TRY(const FitResult fit, fitReflectanceField(source, options));
  const BtfDescription& measured = source.description();
  const ModelledLights lights = fit.field.formula().modelledLights(measured.lights);
  std::array<Range, 3> ranges;
  SampleRows rows;
  WEFT_TRY_VOID(source.readRows(0, measured.height, rows));
  for (int y = 0; y < measured.height; ++y)
    for (int x = 0; x < measured.width; ++x) {
      const glm::dvec3 errors = errorsOf(fit.field, measured, lights, rows, x, y);
      for (int c = 0; c < 3; ++c) {
        Range& range = ranges[static_cast<std::size_t>(c)];
        range = {range.sum + errors[c], std::min(range.smallest, errors[c]),
                 std::max(range.largest, errors[c])};
      }
    }
  fmt::print("{:>3}", components);
  for (const Range& range : ranges)
    fmt::print("   {:.4f} {:.4f} {:.4f}", range.sum / (measured.width * measured.height), range.smallest,
               range.largest);
  fmt::print("   {:.2f} MB\n", static_cast<double>(gpuBytes(fit.field)) / 1e6);
  return {};
}

Result<void> printTable(const char* input, std::span<char*> components) {
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(input));
  fmt::print("  n   Y avg  min    max      Cb avg min    max      Cr avg min    max      GPU\n");
  for (const char* number : components) WEFT_TRY_VOID(printRow(*source, std::atoi(number)));
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fputs("usage: lod_table INPUT COMPONENTS...\n", stderr), 1;
  const auto done = printTable(argv[1], {argv + 2, argv + argc});
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  return done ? 0 : 2;
}
