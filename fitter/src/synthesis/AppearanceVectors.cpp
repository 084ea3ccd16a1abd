#include "weft/synthesis/AppearanceVectors.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "weft/core/Contract.h"

namespace weft {
namespace {

int mirrored(int i, int size) {
  if (i < 0) i = -i - 1;
  return i < size ? i : std::max(2 * size - 1 - i, 0);
}

/// Which texel a place beyond the border shows.
int inside(int i, int size, bool repeats) {
  return repeats ? (i % size + size) % size : std::min(mirrored(i, size), size - 1);
}

/// Means of `side` texels along rows (step 1 in x) or columns.
AppearanceVectors blurredAlong(const AppearanceVectors& vectors, int side, bool repeats, bool rows) {
  AppearanceVectors result = vectors;
  const float share = 1.0f / static_cast<float>(side);
  tbb::parallel_for(0, vectors.height, [&](int y) {
    for (int x = 0; x < vectors.width; ++x) {
      float* out = result.at(x, y);
      std::fill(out, out + vectors.dimensions, 0.0f);
      for (int k = -side / 2; k < side - side / 2; ++k) {
        const float* in = rows ? vectors.at(inside(x + k, vectors.width, repeats), y)
                               : vectors.at(x, inside(y + k, vectors.height, repeats));
        for (int d = 0; d < vectors.dimensions; ++d) out[d] += share * in[d];
      }
    }
  });
  return result;
}

}  // namespace

float AppearanceVectors::distance(int x0, int y0, int x1, int y1) const {
  const float *a = at(x0, y0), *b = at(x1, y1);
  float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
  for (int d = 0; d < dimensions; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(sum);
}

AppearanceVectors blurred(const AppearanceVectors& vectors, int side, bool repeats) {
  WEFT_EXPECT(side > 0, "a mean is of texels");
  return blurredAlong(blurredAlong(vectors, side, repeats, true), side, repeats, false);
}

}  // namespace weft
