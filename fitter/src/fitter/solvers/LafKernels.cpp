// Highway compiles this file once for every instruction set: AVX-512, AVX2 and what every processor
// has.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solvers/LafKernels.cpp"
#include <hwy/foreach_target.h>
// Highway's header must come after that.
#include <hwy/highway.h>

#include <algorithm>

#include "solvers/LafKernels.h"
#include "weft/core/SimdMath-inl.h"

HWY_BEFORE_NAMESPACE();
namespace weft {
namespace HWY_NAMESPACE {
namespace {

struct Point {
  Vector x, y, z;

  HWY_INLINE Point(const LafPoints& points, std::size_t i)
      : x(hn::Load(Tag(), points.x.data() + i)),
        y(hn::Load(Tag(), points.y.data() + i)),
        z(hn::Load(Tag(), points.z.data() + i)) {}

  HWY_INLINE Vector dot(glm::vec3 axes) const {
    return hn::MulAdd(constant(axes.x), x, hn::MulAdd(constant(axes.y), y, hn::Mul(constant(axes.z), z)));
  }
};

// The power less one gives both the value and its derivative without a division; 0 for a base that
// is not positive.
struct Power {
  Vector base, logarithm, lower;

  HWY_INLINE Power(const LafTerms& lobe, const Point& point) {
    const Vector cosine = point.dot(lobe.axes);
    const Mask lit = hn::Gt(cosine, constant(1e-6f));
    base = hn::IfThenElse(lit, cosine, constant(1.0f));
    logarithm = log2(base);
    lower = hn::IfThenElseZero(lit, exp2(hn::Mul(constant(lobe.exponent - 1.0f), logarithm)));
  }
};

HWY_INLINE float sumOf(Vector vector) {
  return hn::GetLane(hn::SumOfLanes(Tag(), vector));
}

// Adds the products of some rows with some others, summed over points in registers, to a Gram
// matrix of vectors.
template <std::size_t kRows, std::size_t kColumns>
void addProducts(const float* rows, std::size_t rowCount, std::size_t vectors, std::size_t row,
                 std::size_t column, float* gram) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  Vector sums[kRows][kColumns];
  for (auto& line : sums)
    for (Vector& sum : line) sum = hn::Zero(d);
  for (std::size_t i = 0; i < vectors; ++i) {
    const float* point = rows + i * rowCount * lanes;
    Vector columns[kColumns];
    for (std::size_t c = 0; c < kColumns; ++c) columns[c] = hn::Load(d, point + (column + c) * lanes);
    for (std::size_t r = 0; r < kRows; ++r) {
      const Vector left = hn::Load(d, point + (row + r) * lanes);
      for (std::size_t c = 0; c < kColumns; ++c) sums[r][c] = hn::MulAdd(left, columns[c], sums[r][c]);
    }
  }
  for (std::size_t r = 0; r < kRows; ++r)
    for (std::size_t c = 0; c < kColumns && column + c <= row + r; ++c) {
      float* entry = gram + ((row + r) * (row + r + 1) / 2 + column + c) * lanes;
      hn::Store(hn::Add(hn::Load(d, entry), sums[r][c]), d, entry);
    }
}

// The rows of one vector of points, one after another.
HWY_INLINE void storeRows(const LafSamples& samples, std::size_t i, const LafTerms* lobes,
                          std::size_t lobeCount, float diffuse, float* row) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const Point point(samples.points, i);
  const Vector scale = hn::Load(d, samples.scales.data() + i);
  Vector residual = hn::MulSub(scale, constant(diffuse), hn::Load(d, samples.targets.data() + i));
  for (std::size_t j = 0; j < lobeCount; ++j, row += 4 * lanes) {
    const LafTerms& lobe = lobes[j];
    const Power power(lobe, point);
    const Vector lower = hn::Mul(scale, power.lower);
    const Vector byAmplitude = hn::Mul(lower, power.base);
    const Vector value = hn::Mul(constant(lobe.amplitude), byAmplitude);
    const Vector byBase = hn::Mul(constant(lobe.amplitude * lobe.exponent), lower);
    residual = hn::Add(residual, value);
    hn::Store(byAmplitude, d, row);
    hn::Store(hn::Mul(byBase, point.dot(lobe.first)), d, row + lanes);
    hn::Store(hn::Mul(byBase, point.dot(lobe.second)), d, row + 2 * lanes);
    const float naturalLogarithm = 0.69314718f;
    hn::Store(hn::Mul(value, hn::Mul(power.logarithm, constant(lobe.exponent * naturalLogarithm))), d,
              row + 3 * lanes);
  }
  hn::Store(scale, d, row);
  hn::Store(residual, d, row + lanes);
}

void addGramHere(const LafSamples& samples, const LafTerms* lobes, std::size_t lobeCount, float diffuse,
                 float* out) {
  constexpr std::size_t vectorsAtOnce = 16;  // their rows stay in the nearest caches
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t lobeRows = 4 * lobeCount;
  const std::size_t rowCount = lobeRows + 2;
  const std::size_t entries = lafGramSize(lobeCount);
  AlignedFloats gram(entries * lanes);
  AlignedFloats rows(vectorsAtOnce * rowCount * lanes);
  const std::size_t points = samples.scales.size();
  for (std::size_t first = 0; first < points; first += vectorsAtOnce * lanes) {
    const std::size_t vectors = std::min(vectorsAtOnce, (points - first) / lanes);
    for (std::size_t i = 0; i < vectors; ++i)
      storeRows(samples, first + i * lanes, lobes, lobeCount, diffuse, rows.data() + i * rowCount * lanes);
    for (std::size_t column = 0; column < lobeRows; column += 4) {
      for (std::size_t row = column; row < lobeRows; row += 4)
        addProducts<4, 4>(rows.data(), rowCount, vectors, row, column, gram.data());
      addProducts<2, 4>(rows.data(), rowCount, vectors, lobeRows, column, gram.data());
    }
    addProducts<2, 2>(rows.data(), rowCount, vectors, lobeRows, lobeRows, gram.data());
  }
  for (std::size_t i = 0; i < entries; ++i) out[i] += sumOf(hn::Load(d, gram.data() + i * lanes));
}

void valuesHere(const LafPoints& points, const LafTerms* lobes, std::size_t lobeCount, float diffuse,
                float* values) {
  const Tag d;
  for (std::size_t i = 0; i < points.x.size(); i += hn::Lanes(d)) {
    const Point point(points, i);
    Vector value = constant(diffuse);
    for (std::size_t j = 0; j < lobeCount; ++j) {
      const Power power(lobes[j], point);
      value = hn::MulAdd(constant(lobes[j].amplitude), hn::Mul(power.lower, power.base), value);
    }
    hn::Store(value, d, values + i);
  }
}

void correlationsHere(const AlignedFloats& scales, const AlignedFloats& residuals, const float* candidates,
                      LafCorrelation* sums, std::size_t count) {
  const Tag d;
  for (std::size_t k = 0; k < count; ++k) {
    const float* candidate = candidates + k * scales.size();
    Vector residual = hn::Zero(d);
    Vector diffuse = hn::Zero(d);
    Vector square = hn::Zero(d);
    for (std::size_t i = 0; i < scales.size(); i += hn::Lanes(d)) {
      const Vector scale = hn::Load(d, scales.data() + i);
      const Vector value = hn::Mul(scale, hn::Load(d, candidate + i));
      residual = hn::MulAdd(value, hn::Load(d, residuals.data() + i), residual);
      diffuse = hn::MulAdd(value, scale, diffuse);
      square = hn::MulAdd(value, value, square);
    }
    sums[k] = {sumOf(residual), sumOf(diffuse), sumOf(square)};
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace weft
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace weft {

HWY_EXPORT(addGramHere);
HWY_EXPORT(valuesHere);
HWY_EXPORT(correlationsHere);

LafPoints::LafPoints(std::span<const glm::vec3> points)
    : x(points.size()), y(points.size()), z(points.size()) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x;
    y[i] = points[i].y;
    z[i] = points[i].z;
  }
}

void addLafGram(const LafSamples& samples, std::span<const LafTerms> lobes, float diffuse,
                std::span<float> gram) {
  HWY_DYNAMIC_DISPATCH(addGramHere)(samples, lobes.data(), lobes.size(), diffuse, gram.data());
}

void lafValues(const LafPoints& points, std::span<const LafTerms> lobes, float diffuse,
               AlignedFloats& values) {
  HWY_DYNAMIC_DISPATCH(valuesHere)(points, lobes.data(), lobes.size(), diffuse, values.data());
}

void lafCorrelations(const AlignedFloats& scales, const AlignedFloats& residuals,
                     const AlignedFloats& candidates, std::span<LafCorrelation> sums) {
  HWY_DYNAMIC_DISPATCH(correlationsHere)
  (scales, residuals, candidates.data(), sums.data(), sums.size());
}

}  // namespace weft
#endif
