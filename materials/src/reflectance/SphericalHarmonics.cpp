#include "SphericalHarmonics.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace weft {
namespace {

constexpr int kBlock = 64;  // texels whose harmonics fit into a processor's cache

constexpr unsigned kOddX = 1, kOddY = 2, kOddZ = 4;

std::size_t triangle(int degree, int order) {
  return static_cast<std::size_t>(degree * (degree + 1) / 2 + order);
}

// The poles lie on Y, as the rows of an environment; the azimuth counts from X towards Z.
glm::dvec2 azimuthOf(glm::vec3 direction) {
  const double length = std::hypot(static_cast<double>(direction.x), static_cast<double>(direction.z));
  return length > 0.0 ? glm::dvec2(direction.x, direction.z) / length : glm::dvec2(1.0, 0.0);
}

}  // namespace

SphericalHarmonics::SphericalHarmonics(int degree) : degree_(degree) {
  for (int l = 0; l <= degree; ++l)
    for (int m = -l; m <= l; ++m) {
      const bool oddOrder = m % 2 != 0, sine = m < 0;
      unsigned odd = (l + m) % 2 != 0 ? kOddY : 0;
      if (sine != oddOrder) odd |= kOddX;
      if (sine) odd |= kOddZ;
      harmonics_.push_back({l, m, odd});
    }
  std::ranges::stable_sort(harmonics_, {}, &Harmonic::odd);
  for (unsigned odd = 0; odd <= 8; ++odd)
    firstOfClass_[odd] =
        static_cast<int>(std::ranges::lower_bound(harmonics_, odd, {}, &Harmonic::odd) - harmonics_.begin());
}

void SphericalHarmonics::legendre(double cosine, std::vector<double>& values) const {
  values.resize(triangle(degree_ + 1, 0));
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  double diagonal = std::sqrt(0.25 / std::numbers::pi);
  for (int m = 0; m <= degree_; ++m) {
    if (m > 0) diagonal *= sine * std::sqrt((2.0 * m + 1.0) / (2.0 * m));
    double before = 0.0, latest = diagonal;
    values[triangle(m, m)] = latest;
    for (int l = m + 1; l <= degree_; ++l) {
      const double l2 = static_cast<double>(l) * l, m2 = static_cast<double>(m) * m;
      const double k2 = (l - 1.0) * (l - 1.0);
      const double a = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
      const double b = std::sqrt((k2 - m2) / (4.0 * k2 - 1.0));
      const double next = a * (cosine * latest - (l > m + 1 ? b * before : 0.0));
      before = latest;
      latest = next;
      values[triangle(l, m)] = latest;
    }
  }
}

void SphericalHarmonics::evaluate(glm::vec3 direction, float* values) const {
  thread_local std::vector<double> heights;
  // cosine and sine of the multiples of the azimuth
  thread_local std::vector<glm::dvec2> multiples;
  legendre(direction.y, heights);
  const glm::dvec2 step = azimuthOf(direction);
  multiples.assign(1, {1.0, 0.0});
  for (int m = 1; m <= degree_; ++m) {
    const glm::dvec2 last = multiples.back();
    multiples.emplace_back(last.x * step.x - last.y * step.y, last.x * step.y + last.y * step.x);
  }
  for (std::size_t i = 0; i < harmonics_.size(); ++i) {
    const Harmonic& each = harmonics_[i];
    const int m = std::abs(each.order);
    const glm::dvec2 turned = multiples[static_cast<std::size_t>(m)];
    const double around = m == 0 ? 1.0 : std::numbers::sqrt2 * (each.order > 0 ? turned.x : turned.y);
    values[i] = static_cast<float>(around * heights[triangle(each.degree, m)]);
  }
}

SphericalHarmonics::Matrix SphericalHarmonics::coefficients(
    const Environment& environment, std::span<const std::function<float(glm::vec3)>> weights) const {
  const int width = environment.width(), height = environment.height();
  const auto functions = static_cast<Eigen::Index>(3 * weights.size());
  const int orders = 2 * degree_ + 1;

  // Of every column of the image: cosine and sine of the multiples of its azimuth, by order.
  Matrix around(orders, width);
  for (int x = 0; x < width; ++x) {
    const glm::dvec2 azimuth = azimuthOf(environment.direction(x, (height - 1) / 2));
    const double phi = std::atan2(azimuth.y, azimuth.x);
    for (int m = -degree_; m <= degree_; ++m)
      around(m + degree_, x) = static_cast<float>(
          m == 0 ? 1.0 : std::numbers::sqrt2 * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi)));
  }

  // Every row's Fourier coefficients, then sums over the rows.
  std::vector<Matrix> rows(static_cast<std::size_t>(height));
  std::vector<std::vector<double>> heights(static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    Matrix values(width, functions);
    for (int x = 0; x < width; ++x) {
      const glm::vec3 direction = environment.direction(x, y);
      const glm::vec3 radiance = environment.texel(x, y);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const float weight = weights[i](direction);
        for (int c = 0; c < 3; ++c) values(x, static_cast<Eigen::Index>(3 * i) + c) = weight * radiance[c];
      }
    }
    const auto row = static_cast<std::size_t>(y);
    rows[row] = static_cast<float>(environment.solidAngle(y)) * (around * values);
    legendre(environment.direction(0, y).y, heights[row]);
  });
  Matrix sums = Matrix::Zero(count(), functions);
  tbb::parallel_for(0, count(), [&](int i) {
    const Harmonic& each = harmonics_[static_cast<std::size_t>(i)];
    for (std::size_t row = 0; row < rows.size(); ++row)
      sums.row(i) += static_cast<float>(heights[row][triangle(each.degree, std::abs(each.order))]) *
                     rows[row].row(each.order + degree_);
  });
  return sums;
}

std::vector<double> SphericalHarmonics::zonal(const std::function<double(double)>& kernel) const {
  constexpr int kSteps = 4096;
  std::vector<double> factors(static_cast<std::size_t>(degree_) + 1, 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double angle = std::numbers::pi * (i + 0.5) / kSteps;
    const double cosine = std::cos(angle);
    const double weight =
        2.0 * std::numbers::pi * std::numbers::pi / kSteps * std::sin(angle) * kernel(cosine);
    if (weight == 0.0) continue;
    double before = 0.0, latest = 1.0;  // Legendre's polynomials
    for (int l = 0; l <= degree_; ++l) {
      factors[static_cast<std::size_t>(l)] += weight * latest;
      const double next = ((2.0 * l + 1.0) * cosine * latest - l * before) / (l + 1.0);
      before = latest;
      latest = next;
    }
  }
  return factors;
}

void SphericalHarmonics::scale(const Matrix& from, int firstFunction, std::span<const double> zonal,
                               Matrix& to, int toFunction) const {
  for (int i = 0; i < count(); ++i) {
    const auto factor =
        static_cast<float>(zonal[static_cast<std::size_t>(harmonics_[static_cast<std::size_t>(i)].degree)]);
    for (int c = 0; c < 3; ++c) to(i, toFunction + c) = factor * from(i, firstFunction + c);
  }
}

FloatImage SphericalHarmonics::onMap(const Matrix& coefficients, OctahedralMap map) const {
  const auto functions = static_cast<int>(coefficients.cols());
  FloatImage image(map.imageSize(), map.imageSize(), {"R", "G", "B"}, functions / 3);

  // The directions of an octant; flipping signs gives all others, and keeps or turns each class of
  // harmonics.
  std::vector<glm::ivec2> octant;
  const int half = map.size / 2;
  for (int y = 0; y < half; ++y)
    for (int x = 0; x + y < half; ++x) octant.emplace_back(half + x, half + y);
  const auto texelOf = [&](glm::vec3 direction) {
    const glm::vec2 place = OctahedralMap::place(direction);
    return glm::ivec2(glm::round(0.5f * (place + 1.0f) * static_cast<float>(map.size) - 0.5f));
  };

  const int blocks = (static_cast<int>(octant.size()) + kBlock - 1) / kBlock;
  tbb::parallel_for(0, blocks, [&](int block) {
    const int first = block * kBlock;
    const int texels = std::min(kBlock, static_cast<int>(octant.size()) - first);
    Matrix basis(texels, count());
    for (int i = 0; i < texels; ++i) {
      const glm::ivec2 texel = octant[static_cast<std::size_t>(first + i)];
      evaluate(map.direction(texel.x, texel.y), basis.row(i).data());
    }
    std::array<Matrix, 8> parts;
    for (std::size_t odd = 0; odd < 8; ++odd) {
      const int begin = firstOfClass_[odd], size = firstOfClass_[odd + 1] - begin;
      parts[odd].noalias() = basis.middleCols(begin, size) * coefficients.middleRows(begin, size);
    }
    for (unsigned flip = 0; flip < 8; ++flip) {
      Matrix sum = parts[0];
      for (unsigned odd = 1; odd < 8; ++odd)
        if (std::popcount(odd & flip) % 2 == 0)
          sum += parts[odd];
        else
          sum -= parts[odd];
      const glm::vec3 signs(flip & kOddX ? -1.0f : 1.0f, flip & kOddY ? -1.0f : 1.0f,
                            flip & kOddZ ? -1.0f : 1.0f);
      for (int i = 0; i < texels; ++i) {
        const glm::ivec2 texel = octant[static_cast<std::size_t>(first + i)];
        const glm::ivec2 to = texelOf(signs * map.direction(texel.x, texel.y));
        for (int f = 0; f < functions; ++f) image.at(to.x + 1, to.y + 1, f % 3, f / 3) = sum(i, f);
      }
    }
  });
  map.fillBorder(image);
  return image;
}

}  // namespace weft
