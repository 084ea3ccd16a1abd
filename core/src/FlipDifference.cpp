#include "weft/core/FlipDifference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "ImagePlane.h"
#include "weft/core/Color.h"
#include "weft/core/Contract.h"

// Names of sections are those of [Andersson 2020].
namespace weft {
namespace {

using Planes = std::array<ImagePlane, 3>;

/// Of linear sRGB, by columns: what its red, green and blue are in CIE XYZ.
const glm::dmat3 kXyzOfRgb{{10135552.0 / 24577794.0, 2613072.0 / 12288897.0, 1425312.0 / 73733382.0},
                           {8788810.0 / 24577794.0, 8788810.0 / 12288897.0, 8788810.0 / 73733382.0},
                           {4435075.0 / 24577794.0, 887015.0 / 12288897.0, 70074185.0 / 73733382.0}};
const glm::dmat3 kRgbOfXyz = glm::inverse(kXyzOfRgb);
const glm::dvec3 kWhite = kXyzOfRgb * glm::dvec3(1.0);

/// YCxCz, or L*a*b* of cube roots: alike but for those.
glm::dvec3 opponentColor(glm::dvec3 relative) {
  return {116.0 * relative.y - 16.0, 500.0 * (relative.x - relative.y), 200.0 * (relative.y - relative.z)};
}

glm::dvec3 linearOfOpponent(glm::dvec3 color) {
  const double y = (color.x + 16.0) / 116.0;
  return kRgbOfXyz * (kWhite * glm::dvec3(y + color.y / 500.0, y, y - color.z / 200.0));
}

double labRoot(double relative) {
  constexpr double kDelta = 6.0 / 29.0;
  return relative > kDelta * kDelta * kDelta ? std::cbrt(relative)
                                             : relative / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

/// L*a*b* with the colours of dark pixels drawn together, as Hunt's effect has it (4.1.3).
glm::dvec3 huntLab(glm::dvec3 linear) {
  const glm::dvec3 relative = kXyzOfRgb * linear / kWhite;
  const glm::dvec3 lab = opponentColor({labRoot(relative.x), labRoot(relative.y), labRoot(relative.z)});
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

/// The HyAB distance, to the power of the paper's q_c.
double colorDistance(glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 d = a - b;
  return std::pow(std::abs(d.x) + std::hypot(d.y, d.z), 0.7);
}

/// Distances of colours as 0 to 1, in which p_c of the largest take up p_t of the range (4.1.4).
double colorError(double distance) {
  static const double largest = colorDistance(huntLab({0, 1, 0}), huntLab({0, 0, 1}));
  constexpr double kShareOfLargest = 0.4, kShareOfRange = 0.95;
  const double knee = kShareOfLargest * largest;
  if (distance < knee) return kShareOfRange / knee * distance;
  return kShareOfRange + (distance - knee) / (largest - knee) * (1.0 - kShareOfRange);
}

/// What the eye makes of a plane (4.1.1): a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b).
struct ContrastGaussian {
  double a, b;
};

ImagePlane seenPlane(const ImagePlane& plane, double pixelsPerDegree,
                     std::span<const ContrastGaussian> gaussians) {
  using std::numbers::pi;
  constexpr double kWidest = 0.04;  // the largest b
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * pi * pi)) * pixelsPerDegree));
  ImagePlane result{plane.width, plane.height, std::vector<double>(plane.values.size())};
  double sum = 0.0;
  for (const auto& [a, b] : gaussians) {
    const double deviation = std::sqrt(b / (2.0 * pi * pi)) * pixelsPerDegree;
    const std::vector<double> kernel = gaussianKernel(radius, deviation);
    // Of the kernel before it was scaled: its middle was 1.
    const double unscaled = 1.0 / kernel[static_cast<std::size_t>(radius)];
    const double weight = a * std::sqrt(pi / b) * unscaled * unscaled;
    const ImagePlane blurred = filtered(plane, kernel, kernel);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += weight * blurred.values[i];
    sum += weight;
  }
  for (double& value : result.values) value /= sum;
  return result;
}

Planes opponentPlanes(const FloatImage& image) {
  Planes planes;
  for (int channel = 0; channel < 3; ++channel)
    planes[static_cast<std::size_t>(channel)] = planeOf(image, [&](std::span<const float> rgb) {
      const glm::dvec3 linear = decode(Encoding::Srgb, glm::vec3(rgb[0], rgb[1], rgb[2]));
      return opponentColor(kXyzOfRgb * linear / kWhite)[channel];
    });
  return planes;
}

Planes seenPlanes(const Planes& planes, double pixelsPerDegree) {
  constexpr std::array<ContrastGaussian, 1> kAchromatic{{{1.0, 0.0047}}}, kRedGreen{{{1.0, 0.0053}}};
  constexpr std::array<ContrastGaussian, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};
  return {seenPlane(planes[0], pixelsPerDegree, kAchromatic),
          seenPlane(planes[1], pixelsPerDegree, kRedGreen),
          seenPlane(planes[2], pixelsPerDegree, kBlueYellow)};
}

glm::dvec3 seenColor(const Planes& planes, std::size_t pixel) {
  const glm::dvec3 color(planes[0].values[pixel], planes[1].values[pixel], planes[2].values[pixel]);
  return huntLab(glm::clamp(linearOfOpponent(color), 0.0, 1.0));
}

/// Positive values scaled to a sum of 1, negative ones to -1.
std::vector<double> balanced(std::vector<double> kernel) {
  double positive = 0.0, negative = 0.0;
  for (const double value : kernel) (value > 0.0 ? positive : negative) += std::abs(value);
  for (double& value : kernel) value /= value > 0.0 ? positive : negative;
  return kernel;
}

/// How strong edges, or points, are in brightness (4.2).
struct FeatureStrength {
  ImagePlane x, y;
  double at(std::size_t pixel) const { return std::hypot(x.values[pixel], y.values[pixel]); }
};

struct Features {
  FeatureStrength edges, points;
};

Features featuresOf(ImagePlane brightness, double pixelsPerDegree) {
  for (double& value : brightness.values) value = (value + 16.0) / 116.0;
  const double deviation = 0.5 * 0.082 * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const std::vector<double> smooth = gaussianKernel(radius, deviation);
  std::vector<double> edge = smooth, point = smooth;
  for (int x = -radius; x <= radius; ++x) {
    const auto i = static_cast<std::size_t>(x + radius);
    edge[i] *= -x;
    point[i] *= x * x / (deviation * deviation) - 1.0;
  }
  edge = balanced(edge);
  point = balanced(point);
  return {{filtered(brightness, edge, smooth), filtered(brightness, smooth, edge)},
          {filtered(brightness, point, smooth), filtered(brightness, smooth, point)}};
}

double featureError(const Features& a, const Features& b, std::size_t pixel) {
  const double edges = std::abs(a.edges.at(pixel) - b.edges.at(pixel));
  const double points = std::abs(a.points.at(pixel) - b.points.at(pixel));
  return std::sqrt(std::max(edges, points) / std::numbers::sqrt2);
}

}  // namespace

FloatImage flipDifference(const FloatImage& a, const FloatImage& b, double pixelsPerDegree) {
  WEFT_EXPECT(a.width() == b.width() && a.height() == b.height(), "FLIP needs pictures of one size");
  const Planes planesA = opponentPlanes(a), planesB = opponentPlanes(b);
  const Planes seenA = seenPlanes(planesA, pixelsPerDegree), seenB = seenPlanes(planesB, pixelsPerDegree);
  const Features featuresA = featuresOf(planesA[0], pixelsPerDegree);
  const Features featuresB = featuresOf(planesB[0], pixelsPerDegree);
  FloatImage result(a.width(), a.height(), {"Y"});
  for (std::size_t i = 0; i < result.values().size(); ++i) {
    const double color = colorError(colorDistance(seenColor(seenA, i), seenColor(seenB, i)));
    result.values()[i] = static_cast<float>(std::pow(color, 1.0 - featureError(featuresA, featuresB, i)));
  }
  return result;
}

}  // namespace weft
