#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/reflectance/Environment.h"
#include "weft/reflectance/OctahedralMap.h"

namespace weft {

/// Functions on the sphere as sums of real spherical harmonics up to a degree: convolving one with
/// a kernel that depends on an angle alone is a multiplication of each degree (Funk and Hecke's
/// theorem).
class SphericalHarmonics {
 public:
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit SphericalHarmonics(int degree);

  int count() const { return (degree_ + 1) * (degree_ + 1); }

  /// The coefficients [harmonic][function] of radiance times each of the weights, three functions
  /// (R, G, B) a weight. Texels count as points of their solid angle.
  Matrix coefficients(const Environment& environment,
                      std::span<const std::function<float(glm::vec3)>> weights) const;

  /// What the harmonics of each degree are multiplied by to convolve with a kernel of the angle's
  /// cosine.
  std::vector<double> zonal(const std::function<double(double cosine)>& kernel) const;

  /// Writes three of the functions after another, multiplied by zonal factors.
  void scale(const Matrix& from, int firstFunction, std::span<const double> zonal, Matrix& to,
             int toFunction) const;

  /// The functions on an octahedral map, three a layer, borders included.
  FloatImage onMap(const Matrix& coefficients, OctahedralMap map) const;

 private:
  /// One harmonic: its degree, order (negative for the sine), and which of x, y, z it is odd in.
  struct Harmonic {
    int degree, order;
    unsigned odd;
  };
  /// All harmonics for one direction, in the order of harmonics_.
  void evaluate(glm::vec3 direction, float* values) const;
  /// The Legendre parts, normalised, at [degree (degree + 1) / 2 + order].
  void legendre(double cosine, std::vector<double>& values) const;

  int degree_;
  std::vector<Harmonic> harmonics_;    ///< sorted by `odd`
  std::array<int, 9> firstOfClass_{};  ///< where each value of `odd` starts
};

}  // namespace weft
