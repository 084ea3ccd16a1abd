#include "weft/core/ImageComparison.h"

#include <cmath>
#include <limits>

#include "weft/core/Contract.h"

namespace weft {
namespace {

bool sameShape(const FloatImage& a, const FloatImage& b) {
  return a.width() == b.width() && a.height() == b.height() && a.layers() == b.layers() &&
         a.channels() == b.channels();
}

// Equal infinities are equal; anything else that is not finite is infinitely wrong, NaN included.
float difference(float a, float b) {
  if (a == b) return 0.0f;
  return std::isfinite(a) && std::isfinite(b) ? std::abs(a - b) : std::numeric_limits<float>::infinity();
}

}  // namespace

ImageComparison compareImages(const FloatImage& actual, const FloatImage& expected, float tolerance) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (!sameShape(actual, expected)) return {infinity, infinity, 1.0, infinity};
  ImageComparison result;
  const auto a = actual.values();
  const auto b = expected.values();
  const std::size_t channels = actual.channels().size();
  std::size_t failing = 0;
  for (std::size_t pixel = 0; pixel < a.size(); pixel += channels) {
    float worst = 0.0f;
    for (std::size_t i = pixel; i < pixel + channels; ++i) {
      const float apart = difference(a[i], b[i]);
      worst = std::max(worst, apart);
      result.mean += apart;
      result.rootMeanSquare += double{apart} * apart;
    }
    result.maximum = std::max(result.maximum, worst);
    if (worst > tolerance) ++failing;
  }
  if (!a.empty()) {
    result.mean /= static_cast<double>(a.size());
    result.rootMeanSquare = std::sqrt(result.rootMeanSquare / static_cast<double>(a.size()));
    result.failingShare = static_cast<double>(failing * channels) / static_cast<double>(a.size());
  }
  return result;
}

FloatImage differenceImage(const FloatImage& actual, const FloatImage& expected, float gain) {
  WEFT_EXPECT(sameShape(actual, expected), "a difference needs images of one shape");
  FloatImage result = actual;
  result.setPrecision(Precision::Float);
  for (std::size_t i = 0; i < result.values().size(); ++i)
    result.values()[i] = gain * difference(actual.values()[i], expected.values()[i]);
  return result;
}

}  // namespace weft
