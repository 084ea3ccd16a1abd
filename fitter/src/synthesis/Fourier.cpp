#include "Fourier.h"

#include <tbb/parallel_for.h>

#include <complex>
#include <unsupported/Eigen/FFT>

namespace weft {
namespace {

void transformColumns(Eigen::MatrixXcd& plane) {
  tbb::parallel_for(Eigen::Index{0}, plane.cols(), [&](Eigen::Index i) {
    Eigen::FFT<double> fft;
    Eigen::VectorXcd out;
    fft.fwd(out, Eigen::VectorXcd(plane.col(i)));
    plane.col(i) = out;
  });
}

}  // namespace

Eigen::MatrixXcd fourier(const Eigen::MatrixXd& plane) {
  Eigen::MatrixXcd columns = plane.cast<std::complex<double>>();
  transformColumns(columns);
  Eigen::MatrixXcd rows = columns.transpose();
  transformColumns(rows);
  return rows.transpose();
}

// A power spectrum is real and even, so that both directions of the transform are one.
Eigen::MatrixXd correlationOf(const Eigen::MatrixXd& power) {
  return fourier(power).real() / static_cast<double>(power.size());
}

}  // namespace weft
