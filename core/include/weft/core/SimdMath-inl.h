// Logarithm and power of two for Highway's vectors of floats, with the means that share their code.
// Highway includes such a file once for every instruction set, hence the guard that toggles.
#if defined(WEFT_CORE_SIMD_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WEFT_CORE_SIMD_MATH_INL_H
#undef WEFT_CORE_SIMD_MATH_INL_H
#else
#define WEFT_CORE_SIMD_MATH_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace weft {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Vector = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

HWY_INLINE Vector constant(float value) {
  return hn::Set(Tag(), value);
}

// Degree 7 over sqrt(1/2)..sqrt(2), error 3e-7; for positive, normal numbers.
HWY_INLINE Vector log2(Vector x) {
  const hn::RebindToSigned<Tag> integers;
  const auto bits = hn::BitCast(integers, x);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(integers, 0x3f3504f3)));
  const Vector t = hn::Sub(hn::BitCast(Tag(), hn::Sub(bits, hn::ShiftLeft<23>(exponent))), constant(1.0f));
  constexpr std::array coefficients{-0.14620353f, 0.23420985f, -0.24882181f, 0.2870756f,
                                    -0.36024198f, 0.48092404f, -0.72135276f, 1.4426949f};
  Vector sum = constant(coefficients[0]);
  for (std::size_t i = 1; i < coefficients.size(); ++i) sum = hn::MulAdd(sum, t, constant(coefficients[i]));
  return hn::MulAdd(sum, t, hn::ConvertTo(Tag(), exponent));
}

// Degree 5 over -1/2..1/2, relative error 8e-8. Ends at 2^-40: smaller values, and products of
// them, would become denormal numbers, which cost a hundred times as much as others and change
// nothing. Ends at 2^126, too.
HWY_INLINE Vector exp2(Vector x) {
  const hn::RebindToSigned<Tag> integers;
  x = hn::Min(hn::Max(x, constant(-40.0f)), constant(126.0f));
  const Vector whole = hn::Round(x);
  const Vector t = hn::Sub(x, whole);
  constexpr std::array coefficients{0.00134004f, 0.00967604f, 0.05550327f,
                                    0.24022107f, 0.69314718f, 1.0000001f};
  Vector sum = constant(coefficients[0]);
  for (std::size_t i = 1; i < coefficients.size(); ++i) sum = hn::MulAdd(sum, t, constant(coefficients[i]));
  const auto power = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(integers, whole), hn::Set(integers, 127)));
  return hn::Mul(sum, hn::BitCast(Tag(), power));
}

}  // namespace HWY_NAMESPACE
}  // namespace weft
HWY_AFTER_NAMESPACE();

#endif
