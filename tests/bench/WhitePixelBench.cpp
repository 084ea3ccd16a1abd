// Hunts white pixels ([Meseth 2004] 5.3): values of a fitted field that are not finite, or exceed
// 1.5 times the texel's largest measured luminance in that view, for random lights of the whole
// hemisphere.
//
//     white_pixel_bench INPUT FIELD.rf.exr [EVALUATIONS]
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <random>

#include "weft/core/Color.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/measurement/BtfSource.h"

namespace {

using namespace weft;

glm::vec3 randomLight(std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const float z = unit(random);
  const float phi = 2.0f * static_cast<float>(M_PI) * unit(random);
  const float across = std::sqrt(1.0f - z * z);
  return {across * std::cos(phi), across * std::sin(phi), z};
}

struct Count {
  std::size_t notFinite = 0;
  std::size_t tooBright = 0;
  float worst = 0.0f;  // times the largest measured value
};

Count huntIn(const ReflectanceField& field, const BtfDescription& measured,
             const std::vector<glm::vec3>& samples, int x, int y, std::size_t evaluations) {
  const std::size_t lights = measured.lights.size();
  std::vector<float> brightest(measured.views.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    brightest[i / lights] = std::max(brightest[i / lights], luminance(samples[i]));
  std::mt19937 random(static_cast<std::uint32_t>(y * field.width() + x));
  Count count;
  for (std::size_t i = 0; i < evaluations; ++i) {
    const std::size_t view = random() % measured.views.size();
    const float value = luminance(field.evaluate(x, y, randomLight(random), measured.views[view]));
    if (!std::isfinite(value)) ++count.notFinite;
    if (brightest[view] <= 0.0f) continue;
    if (value > 1.5f * brightest[view]) ++count.tooBright;
    count.worst = std::max(count.worst, value / brightest[view]);
  }
  return count;
}

Result<void> hunt(const char* input, const char* file, std::size_t evaluations) {
  WEFT_TRY(const std::unique_ptr<BtfSource> source, openBtf(input));
  WEFT_TRY(const ReflectanceField field, readReflectanceField(file, ModelRegistry::builtin()));
  const BtfDescription& measured = source->description();
  if (measured.width != field.width() || measured.height != field.height())
    return fail("the field is not of this measurement");
  SampleRows rows;
  WEFT_TRY_VOID(source->readRows(0, measured.height, rows));
  const std::size_t each = evaluations / measured.texels() + 1;
  Count sum;
  std::mutex mutex;
  tbb::parallel_for(0, field.width() * field.height(), [&](int i) {
    const int x = i % field.width();
    const int y = i / field.width();
    std::vector<glm::vec3> samples(rows.pairs());
    rows.linear(y, x, samples);
    const Count count = huntIn(field, measured, samples, x, y, each);
    const std::scoped_lock lock(mutex);
    sum.notFinite += count.notFinite;
    sum.tooBright += count.tooBright;
    sum.worst = std::max(sum.worst, count.worst);
  });
  fmt::print(
      "{}: {} evaluations, {} not finite, {} above 1.5 times the largest measured value, the brightest "
      "{:.2f} times\n",
      file, each * measured.texels(), sum.notFinite, sum.tooBright, sum.worst);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "white_pixel_bench INPUT FIELD.rf.exr [EVALUATIONS]\n");
    return 1;
  }
  const Result<void> result =
      hunt(argv[1], argv[2], argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 100'000'000);
  if (!result) fmt::print(stderr, "{}\n", result.error().message());
  return result ? 0 : 2;
}
