#include "weft/reflectance/LightMaps.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "weft/core/Contract.h"
#include "weft/core/Direction.h"
#include "weft/core/HemisphereTriangulation.h"
#include "weft/reflectance/LightMap.h"

namespace weft {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Points = std::vector<glm::dvec2>;

glm::dvec2 discFromDirection(glm::dvec3 direction) {
  return glm::dvec2(direction.x, direction.y) / std::sqrt(1.0 + std::max(direction.z, 0.0));
}

// The inverse; points beyond the disc count as on its edge.
glm::dvec3 directionFromDisc(glm::dvec2 point) {
  const double radius = glm::length(point);
  if (radius > 1.0) point /= radius;
  const double z = 1.0 - glm::dot(point, point);
  return {point * std::sqrt(1.0 + z), z};
}

Points discPoints(std::span<const glm::vec3> directions) {
  Points points;
  for (glm::vec3 direction : directions) points.push_back(discFromDirection(direction));
  return points;
}

// Of every texel's centre.
Points texelPoints(int size) {
  Points points;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      points.push_back(glm::dvec2(column, row) / (0.5 * (size - 1)) - 1.0);
  return points;
}

// Moves points to the hull of lights that span an area.
Points onHull(const HemisphereTriangulation& triangulation, std::span<const glm::vec3> lights,
              Points points) {
  for (glm::dvec2& point : points) {
    const DirectionWeights weights = triangulation.locate(directionFromDisc(point));
    glm::dvec2 parabolic(0.0);
    for (int k = 0; k < 3; ++k)
      parabolic += static_cast<double>(weights.weight[k]) *
                   glm::dvec2(parabolicFromDirection(
                       lights[static_cast<std::size_t>(weights.index[static_cast<std::size_t>(k)])]));
    const double square = glm::dot(parabolic, parabolic);
    point = discFromDirection(glm::dvec3(2.0 * parabolic, 1.0 - square) / (1.0 + square));
  }
  return points;
}

// Moves points to the line along which lights lie, between the outermost; `lights` are around 0.
Points onLine(const Points& lights, Points points) {
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (glm::dvec2 light : lights) {
    const Eigen::Vector2d at(light.x, light.y);
    spread += at * at.transpose();
  }
  const Eigen::Vector2d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
  const glm::dvec2 along(axis.x(), axis.y());
  double first = 0.0;
  double last = 0.0;
  for (glm::dvec2 light : lights) {
    first = std::min(first, glm::dot(light, along));
    last = std::max(last, glm::dot(light, along));
  }
  for (glm::dvec2& point : points) point = along * std::clamp(glm::dot(point, along), first, last);
  return points;
}

double thinPlate(double squaredRadius) {
  return squaredRadius > 0.0 ? squaredRadius * std::log(squaredRadius) : 0.0;
}

// Kernel values and an affine function's terms at points: a row a point.
Rows splineTerms(const Points& points, const Points& lights) {
  Rows terms(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(lights.size()) + 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < lights.size(); ++j) {
      const glm::dvec2 apart = points[i] - lights[j];
      terms(row, static_cast<Eigen::Index>(j)) = thinPlate(glm::dot(apart, apart));
    }
    terms.row(row).tail<3>() << 1.0, points[i].x, points[i].y;
  }
  return terms;
}

// A row a point: what it takes of each light's value. Where lights leave the affine function open,
// it is the flattest.
Rows splineWeights(const Points& points, const Points& lights) {
  const auto count = static_cast<Eigen::Index>(lights.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 3, count + 3);
  system.topRows(count) = splineTerms(lights, lights);
  system.bottomLeftCorner(3, count) = system.topRightCorner(count, 3).transpose();
  const Eigen::MatrixXd inverse = system.completeOrthogonalDecomposition().pseudoInverse();
  return splineTerms(points, lights) * inverse.leftCols(count);
}

// A row a light: the texels that a bilinear sample reads there.
Rows samplingWeights(std::span<const glm::vec3> lights, int size) {
  Rows weights = Rows::Zero(static_cast<Eigen::Index>(lights.size()), Eigen::Index{size} * size);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightMapTexels texels = lightMapTexels(lights[i], size);
    for (int corner = 0; corner < 4; ++corner)
      weights(static_cast<Eigen::Index>(i), texels.index[corner]) += double{texels.weight[corner]};
  }
  return weights;
}

Points movedBy(Points points, glm::dvec2 offset) {
  for (glm::dvec2& point : points) point += offset;
  return points;
}

Rows interpolated(std::span<const glm::vec3> lights, int size) {
  Points known = discPoints(lights);
  glm::dvec2 centre(0.0);
  for (glm::dvec2 point : known) centre += point / static_cast<double>(known.size());
  known = movedBy(known, -centre);
  const auto triangulation = HemisphereTriangulation::create(lights);
  const bool area = lights.size() > 2 && triangulation;
  const Points wanted = area ? movedBy(onHull(*triangulation, lights, texelPoints(size)), -centre)
                             : onLine(known, movedBy(texelPoints(size), -centre));
  return splineWeights(wanted, known);
}

}  // namespace

LightMaps::LightMaps(std::span<const glm::vec3> lights, int size) : size_(size), lights_(lights.size()) {
  WEFT_EXPECT(!lights.empty() && size >= 2, "a light map has lights and texels");
  Rows weights = interpolated(lights, size);
  // The smallest change of texels that makes samples at the lights exact, but where two lights are
  // within a tenth of a texel, of which slopes without bound would come.
  const Rows sampling = samplingWeights(lights, size);
  const Rows missing = Rows::Identity(sampling.rows(), sampling.rows()) - sampling * weights;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(0.1);
  weights += decomposition.compute(sampling).solve(missing);
  weights_.resize(static_cast<std::size_t>(weights.size()));
  std::transform(weights.data(), weights.data() + weights.size(), weights_.begin(),
                 [](double weight) { return static_cast<float>(weight); });
}

int LightMaps::sizeFor(std::size_t lights) {
  for (int size = 2;; size += 2) {
    const Points points = texelPoints(size);
    const auto usable = std::count_if(points.begin(), points.end(),
                                      [](glm::dvec2 point) { return glm::dot(point, point) <= 1.0; });
    if (static_cast<std::size_t>(usable) >= 2 * lights) return size;
  }
}

std::vector<float> LightMaps::filled(std::span<const float> values, std::size_t channels) const {
  WEFT_EXPECT(values.size() == lights_ * channels, "every light has a value of every channel");
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto lightCount = static_cast<Eigen::Index>(lights_);
  const auto channelCount = static_cast<Eigen::Index>(channels);
  const Eigen::Index texels = Eigen::Index{size_} * size_;
  std::vector<float> maps(static_cast<std::size_t>(texels * channelCount));
  Eigen::Map<Matrix>(maps.data(), texels, channelCount).noalias() =
      Eigen::Map<const Matrix>(weights_.data(), texels, lightCount) *
      Eigen::Map<const Matrix>(values.data(), lightCount, channelCount);
  return maps;
}

}  // namespace weft
