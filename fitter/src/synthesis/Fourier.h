#pragma once

#include <Eigen/Core>

namespace weft {

/// The discrete Fourier transform of rows and columns, without a factor.
Eigen::MatrixXcd fourier(const Eigen::MatrixXd& plane);

/// The sum over all texels of a plane's value times that at a shift, round the torus:
/// `[shift.y][shift.x]`, from its power spectrum.
Eigen::MatrixXd correlationOf(const Eigen::MatrixXd& power);

}  // namespace weft
