#include "solvers/LightPolynomials.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/reflectance/LightMap.h"

namespace weft {
namespace {

constexpr int kTerms = 6;
using Terms = Eigen::Matrix<double, kTerms, 1>;
using Products = Eigen::Matrix<double, kTerms, Eigen::Dynamic, Eigen::RowMajor>;

Terms termsOf(glm::dvec3 light) {
  Terms terms;
  terms << light.x * light.x, light.y * light.y, light.x * light.y, light.x, light.y, 1.0;
  return terms;
}

}  // namespace

std::vector<float> lightPolynomials(std::span<const float> map, int size, std::size_t channels,
                                    std::size_t firstLinear, std::size_t endLinear) {
  constexpr int kSteps = 48;  // across the disc, whose parts of equal area are equal solid angles
  Eigen::Matrix<double, kTerms, kTerms> gram = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Products products = Products::Zero(kTerms, static_cast<Eigen::Index>(channels));
  Eigen::RowVectorXd value(static_cast<Eigen::Index>(channels));
  for (int row = 0; row < kSteps; ++row)
    for (int column = 0; column < kSteps; ++column) {
      const glm::dvec2 disc = (glm::dvec2(column, row) + 0.5) * (2.0 / kSteps) - 1.0;
      const double squared = glm::dot(disc, disc);
      if (squared >= 1.0) continue;
      const glm::dvec3 light(disc * std::sqrt(2.0 - squared), 1.0 - squared);
      const LightMapTexels texels = lightMapTexels(glm::vec3(light), size);
      value.setZero();
      for (int corner = 0; corner < 4; ++corner)
        value += double{texels.weight[corner]} *
                 Eigen::Map<const Eigen::RowVectorXf>(
                     map.data() + static_cast<std::size_t>(texels.index[corner]) * channels,
                     static_cast<Eigen::Index>(channels))
                     .cast<double>();
      const Terms terms = termsOf(light);
      gram += light.z * terms * terms.transpose();
      products += light.z * terms * value;
    }
  const Products quadratic = gram.llt().solve(products);
  const Eigen::Matrix<double, 3, Eigen::Dynamic> linear =
      gram.bottomRightCorner<3, 3>().llt().solve(products.bottomRows<3>());
  std::vector<float> polynomials(kTerms * channels);
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const bool isLinear = channel >= firstLinear && channel < endLinear;
    const auto c = static_cast<Eigen::Index>(channel);
    for (int term = isLinear ? 3 : 0; term < kTerms; ++term)
      polynomials[static_cast<std::size_t>(term) * channels + channel] =
          static_cast<float>(isLinear ? linear(term - 3, c) : quadratic(term, c));
  }
  return polynomials;
}

FloatImage lightPolynomialTable(const FloatImage& maps, int levels, std::size_t firstLinear,
                                std::size_t endLinear) {
  const int size = maps.height() / levels, views = maps.width() / size;
  const auto channels = static_cast<std::size_t>(maps.channelCount());
  FloatImage table(kTerms, views * levels, maps.channels());
  tbb::parallel_for(0, views * levels, [&](int row) {
    std::vector<float> map;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const std::span<const float> texel = maps.texel(row % views * size + x, row / views * size + y);
        map.insert(map.end(), texel.begin(), texel.end());
      }
    const std::vector<float> found = lightPolynomials(map, size, channels, firstLinear, endLinear);
    for (int term = 0; term < kTerms; ++term)
      std::copy_n(found.data() + static_cast<std::size_t>(term) * channels, channels,
                  table.texel(term, row).begin());
  });
  table.roundToHalf();
  return table;
}

}  // namespace weft
