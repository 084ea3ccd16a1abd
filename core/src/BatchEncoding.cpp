// Highway compiles this file once for every instruction set.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "BatchEncoding.cpp"
#include <hwy/foreach_target.h>
// Highway's header must come after that.
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "weft/core/BatchEncoding.h"
#include "weft/core/SimdMath-inl.h"

HWY_BEFORE_NAMESPACE();
namespace weft {
namespace HWY_NAMESPACE {

HWY_INLINE Vector power(Vector base, float exponent) {
  const Mask positive = hn::Gt(base, constant(1e-30f));
  const Vector safe = hn::IfThenElse(positive, base, constant(1.0f));
  return hn::IfThenElseZero(positive, exp2(hn::Mul(log2(safe), constant(exponent))));
}

HWY_INLINE Vector decodeVector(Encoding encoding, Vector stored) {
  if (encoding == Encoding::Gamma22) return power(stored, 2.2f);
  const Vector curve = power(hn::Mul(hn::Add(stored, constant(0.055f)), constant(1.0f / 1.055f)), 2.4f);
  return hn::IfThenElse(hn::Le(stored, constant(0.04045f)), hn::Mul(stored, constant(1.0f / 12.92f)), curve);
}

HWY_INLINE Vector encodeVector(Encoding encoding, Vector linear) {
  if (encoding == Encoding::Gamma22) return power(linear, 1.0f / 2.2f);
  const Vector curve = hn::Sub(hn::Mul(power(linear, 1.0f / 2.4f), constant(1.055f)), constant(0.055f));
  return hn::IfThenElse(hn::Le(linear, constant(0.0031308f)), hn::Mul(linear, constant(12.92f)), curve);
}

// Calls `function` with whole vectors; the last one is padded.
template <class Function>
HWY_INLINE void forEachVector(std::span<float> values, const Function& function) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  const auto clamped = [](Vector v) { return hn::Max(v, constant(0.0f)); };
  for (; i + lanes <= values.size(); i += lanes)
    hn::StoreU(function(clamped(hn::LoadU(d, &values[i]))), d, &values[i]);
  if (i == values.size()) return;
  HWY_ALIGN std::array<float, HWY_MAX_BYTES / sizeof(float)> rest{};
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(i), values.end(), rest.begin());
  hn::Store(function(clamped(hn::Load(d, rest.data()))), d, rest.data());
  std::copy_n(rest.begin(), values.size() - i, values.begin() + static_cast<std::ptrdiff_t>(i));
}

void decodeAll(Encoding encoding, std::span<float> values) {
  forEachVector(values, [&](Vector v) { return decodeVector(encoding, v); });
}

void encodeAll(Encoding encoding, std::span<float> values) {
  forEachVector(values, [&](Vector v) { return encodeVector(encoding, v); });
}

}  // namespace HWY_NAMESPACE
}  // namespace weft
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace weft {

HWY_EXPORT(decodeAll);
HWY_EXPORT(encodeAll);

void decodeAll(Encoding encoding, std::span<float> values) {
  if (encoding == Encoding::Linear)
    for (float& value : values) value = std::max(value, 0.0f);
  else
    HWY_DYNAMIC_DISPATCH(decodeAll)(encoding, values);
}

void encodeAll(Encoding encoding, std::span<float> values) {
  if (encoding == Encoding::Linear)
    for (float& value : values) value = std::max(value, 0.0f);
  else
    HWY_DYNAMIC_DISPATCH(encodeAll)(encoding, values);
}

}  // namespace weft
#endif
