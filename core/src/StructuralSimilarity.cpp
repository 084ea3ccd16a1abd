#include "weft/core/StructuralSimilarity.h"

#include "ImagePlane.h"
#include "weft/core/Color.h"
#include "weft/core/Contract.h"

namespace weft {
namespace {

constexpr int kSimilarityRadius = kSimilarityWindow / 2;
constexpr double kLuminanceConstant = 0.01 * 0.01;
constexpr double kContrastConstant = 0.03 * 0.03;

ImagePlane luminanceOf(const FloatImage& image) {
  return planeOf(image, [](std::span<const float> rgb) { return luminance({rgb[0], rgb[1], rgb[2]}); });
}

/// The weighted means, in all windows, of the products of two planes.
ImagePlane meanOfProducts(const ImagePlane& a, const ImagePlane& b, std::span<const double> kernel) {
  ImagePlane product = a;
  for (std::size_t i = 0; i < product.values.size(); ++i) product.values[i] *= b.values[i];
  return filtered(product, kernel, kernel);
}

}  // namespace

FloatImage structuralSimilarity(const FloatImage& a, const FloatImage& b) {
  WEFT_EXPECT(a.width() == b.width() && a.height() == b.height(), "similarity needs pictures of one size");
  WEFT_EXPECT(a.width() >= kSimilarityWindow && a.height() >= kSimilarityWindow, "a window fits in");
  const std::vector<double> kernel = gaussianKernel(kSimilarityRadius, 1.5);
  const ImagePlane lumaA = luminanceOf(a), lumaB = luminanceOf(b);
  const ImagePlane meanA = filtered(lumaA, kernel, kernel), meanB = filtered(lumaB, kernel, kernel);
  const ImagePlane squareA = meanOfProducts(lumaA, lumaA, kernel);
  const ImagePlane squareB = meanOfProducts(lumaB, lumaB, kernel);
  const ImagePlane product = meanOfProducts(lumaA, lumaB, kernel);
  FloatImage result(a.width() - 2 * kSimilarityRadius, a.height() - 2 * kSimilarityRadius, {"Y"});
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x) {
      const auto i = static_cast<std::size_t>(y + kSimilarityRadius) * static_cast<std::size_t>(a.width()) +
                     static_cast<std::size_t>(x + kSimilarityRadius);
      const double mA = meanA.values[i], mB = meanB.values[i];
      const double variances = squareA.values[i] - mA * mA + squareB.values[i] - mB * mB;
      const double covariance = product.values[i] - mA * mB;
      result.at(x, y, 0) =
          static_cast<float>((2.0 * mA * mB + kLuminanceConstant) * (2.0 * covariance + kContrastConstant) /
                             ((mA * mA + mB * mB + kLuminanceConstant) * (variances + kContrastConstant)));
    }
  return result;
}

}  // namespace weft
