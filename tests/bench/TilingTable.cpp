// What stochastic tiling (stochasticPlace()) makes of fitted fields beside the sample itself:
//
//   tiling_table NAME.rf.exr...
//
// Of luminances under lights and views from the top and from low: how far the mean moves, how much
// of the contrast stays (standard deviations of texels, and of means of 8 x 8), what share is cut
// off below 0, and how alike texels one sample apart are (1 where the sample repeats).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "weft/core/Color.h"
#include "weft/core/Direction.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/reflectance/StochasticTiling.h"

namespace {

using namespace weft;

constexpr int kSamples = 8;  // the surface's side
constexpr int kBlock = 8;

struct Grey {
  int width, height;
  std::vector<double> values;
  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

Grey greyOf(int width, int height) {
  return {width, height,
          std::vector<double>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

double meanOf(const Grey& grey) {
  double sum = 0.0;
  for (const double value : grey.values) sum += value;
  return sum / static_cast<double>(grey.values.size());
}

double deviationOf(const Grey& grey) {
  const double mean = meanOf(grey);
  double sum = 0.0;
  for (const double value : grey.values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(grey.values.size()));
}

Grey blocksOf(Grey& grey) {
  Grey blocks = greyOf(grey.width / kBlock, grey.height / kBlock);
  for (int y = 0; y < blocks.height * kBlock; ++y)
    for (int x = 0; x < blocks.width * kBlock; ++x)
      blocks.at(x / kBlock, y / kBlock) += grey.at(x, y) / (kBlock * kBlock);
  return blocks;
}

double correlationOneSampleApart(Grey& grey, int side) {
  const double mean = meanOf(grey), variance = std::pow(deviationOf(grey), 2);
  double sum = 0.0;
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x + side < grey.width; ++x) sum += (grey.at(x, y) - mean) * (grey.at(x + side, y) - mean);
  return sum / (variance * grey.height * (grey.width - side));
}

Grey sampleSeen(const ReflectanceField& field, glm::vec3 light, glm::vec3 view) {
  Grey sample = greyOf(field.width(), field.height());
  for (int y = 0; y < sample.height; ++y)
    for (int x = 0; x < sample.width; ++x)
      sample.at(x, y) = double{luminance(field.evaluate(x, y, light, view))};
  return sample;
}

Grey tiledAtRandom(Grey& sample, double& cut) {
  Grey surface = greyOf(kSamples * sample.width, kSamples * sample.height);
  const double mean = meanOf(sample);
  const glm::vec2 size(sample.width, sample.height);
  for (int y = 0; y < surface.height; ++y)
    for (int x = 0; x < surface.width; ++x) {
      const StochasticPlace place = stochasticPlace((glm::vec2(x, y) + 0.5f) / size);
      double value = double{place.meanShare} * mean;
      for (const TilingTap& tap : place.taps) {
        const glm::ivec2 texel = glm::floor(glm::fract(tap.texcoord) * size);
        value += double{tap.share} * sample.at(texel.x, texel.y);
      }
      cut += value < 0.0 ? 1.0 / static_cast<double>(surface.values.size()) : 0.0;
      surface.at(x, y) = std::max(value, 0.0);
    }
  return surface;
}

Result<void> printTable(const char* file) {
  WEFT_TRY(const ReflectanceField field, readReflectanceField(file));
  fmt::print("{}: {} x {} texels\n", file, field.width(), field.height());
  fmt::print("| light, view | mean, % | contrast | of 8 x 8 | below 0, % | one sample apart |\n");
  for (const double lightTheta : {15.0, 60.0})
    for (const double viewTheta : {0.0, 45.0, 75.0}) {
      Grey sample =
          sampleSeen(field, directionFromDegrees(lightTheta, 60.0), directionFromDegrees(viewTheta, 0.0));
      double cut = 0.0;
      Grey surface = tiledAtRandom(sample, cut);
      fmt::print("| {}, {} | {:+.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", lightTheta, viewTheta,
                 100.0 * (meanOf(surface) / meanOf(sample) - 1.0), deviationOf(surface) / deviationOf(sample),
                 deviationOf(blocksOf(surface)) / deviationOf(blocksOf(sample)), 100.0 * cut,
                 correlationOneSampleApart(surface, sample.width));
    }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return fmt::print(stderr, "tiling_table NAME.rf.exr...\n"), 1;
  for (int i = 1; i < argc; ++i)
    if (const auto done = printTable(argv[i]); !done)
      return fmt::print(stderr, "{}\n", done.error().message()), 2;
  return 0;
}
