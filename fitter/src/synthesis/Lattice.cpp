#include "Lattice.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "Fourier.h"

namespace weft {
namespace {

/// The strongest dimensions show what is regular.
constexpr int kWaveDimensions = 6;
/// A wave has this share of the power, and is so many times as strong as others of about its
/// length, which noise is not.
constexpr double kWaveShare = 0.06, kProminence = 14.0;
constexpr double kFewestPeriods = 1.9;
constexpr double kShortestPeriod = 4.0;  // texels

using ComplexNumber = std::complex<double>;

/// A sample's strongest dimensions with its borders faded out, and its power at a wave.
class Spectrum {
 public:
  Spectrum(const AppearanceVectors& vectors, const SourceRegion& region) : region_(region) {
    for (int d = 0; d < std::min(vectors.dimensions, kWaveDimensions); ++d)
      planes_.push_back(faded(vectors, region, d));
    power_ = Eigen::MatrixXd::Zero(region.height, region.width);
    for (const Eigen::MatrixXd& plane : planes_) power_ += fourier(plane).cwiseAbs2();
  }

  /// Frequencies of an index, -1/2..1/2.
  glm::dvec2 waveAt(int row, int column) const {
    const auto frequency = [](int i, int size) { return (i > size / 2 ? i - size : i) / double(size); };
    return {frequency(column, region_.width), frequency(row, region_.height)};
  }
  /// In bins.
  double periods(glm::dvec2 wave) const {
    return std::hypot(wave.x * region_.width, wave.y * region_.height);
  }
  const Eigen::MatrixXd& power() const { return power_; }

  /// The share of all power in the peak at a wave.
  double share(glm::dvec2 wave) const {
    double peak = 0.0, all = 0.0;
    for (int row = 0; row < power_.rows(); ++row)
      for (int column = 0; column < power_.cols(); ++column) {
        const glm::dvec2 at = waveAt(row, column);
        if (periods(at) < 1.5) continue;
        all += power_(row, column);
        if (isPeakOf(wave, at)) peak += power_(row, column);
      }
    return all > 0.0 ? peak / all : 0.0;
  }

  /// How many times as strong a wave is as the mean of those between 2/3 and 3/2 of its length,
  /// but for itself and those that are known.
  double prominence(glm::dvec2 wave, const std::vector<glm::dvec2>& known) const {
    double sum = 0.0, count = 0.0;
    for (int row = 0; row < power_.rows(); ++row)
      for (int column = 0; column < power_.cols(); ++column) {
        const glm::dvec2 at = waveAt(row, column);
        const double length = glm::length(at) / glm::length(wave);
        if (length < 2.0 / 3.0 || length > 1.5 || isPeakOf(wave, at) ||
            std::any_of(known.begin(), known.end(), [&](glm::dvec2 k) { return isPeakOf(k, at); }))
          continue;
        sum += power_(row, column);
        count += 1.0;
      }
    return count > 0.0 && sum > 0.0 ? powerAt(wave) * count / sum : 0.0;
  }

  /// The wave between bins where the power is largest.
  glm::dvec2 refined(glm::dvec2 wave) const {
    double step = 0.5;
    for (int round = 0; round < 6; ++round, step *= 0.5) {
      glm::dvec2 best = wave;
      double most = -1.0;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const glm::dvec2 at =
              wave + step * glm::dvec2(double(i) / region_.width, double(j) / region_.height);
          if (const double power = powerAt(at); power > most) most = power, best = at;
        }
      wave = best;
    }
    return wave;
  }

 private:
  bool isPeakOf(glm::dvec2 wave, glm::dvec2 at) const {
    return std::min(periods(at - wave), periods(at + wave)) < 1.6;
  }
  static Eigen::MatrixXd faded(const AppearanceVectors& vectors, const SourceRegion& region, int dimension) {
    Eigen::MatrixXd plane(region.height, region.width);
    for (int y = 0; y < region.height; ++y)
      for (int x = 0; x < region.width; ++x)
        plane(y, x) = double{vectors.at(region.x + x, region.y + y)[dimension]};
    plane.array() -= plane.mean();
    const auto hann = [](int i, int size) {
      return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (i + 0.5) / size);
    };
    for (int y = 0; y < region.height; ++y)
      for (int x = 0; x < region.width; ++x) plane(y, x) *= hann(x, region.width) * hann(y, region.height);
    return plane;
  }

  double powerAt(glm::dvec2 wave) const {
    const auto phases = [](double frequency, int size) {
      Eigen::VectorXcd result(size);
      for (int i = 0; i < size; ++i) result[i] = std::polar(1.0, -2.0 * std::numbers::pi * frequency * i);
      return result;
    };
    const Eigen::VectorXcd alongX = phases(wave.x, region_.width), alongY = phases(wave.y, region_.height);
    double power = 0.0;
    for (const Eigen::MatrixXd& plane : planes_)
      power += std::norm((alongY.transpose() * (plane.cast<ComplexNumber>() * alongX))(0));
    return power;
  }

  SourceRegion region_;
  std::vector<Eigen::MatrixXd> planes_;
  Eigen::MatrixXd power_;
};

/// Whether a wave says nothing new beside one that is known: it is parallel to it.
bool isParallel(glm::dvec2 a, glm::dvec2 b) {
  return std::abs(a.x * b.y - a.y * b.x) < 0.35 * glm::length(a) * glm::length(b);
}

std::optional<glm::dvec2> strongestWave(const Spectrum& spectrum, const std::vector<glm::dvec2>& known) {
  std::optional<glm::dvec2> best;
  double most = 0.0;
  for (int row = 0; row < spectrum.power().rows(); ++row)
    for (int column = 0; column < spectrum.power().cols(); ++column) {
      const glm::dvec2 wave = spectrum.waveAt(row, column);
      if (wave.x < 0.0 || spectrum.periods(wave) < kFewestPeriods ||
          glm::length(wave) > 1.0 / kShortestPeriod)
        continue;
      if (std::any_of(known.begin(), known.end(), [&](glm::dvec2 k) { return isParallel(k, wave); }))
        continue;
      if (spectrum.power()(row, column) > most) most = spectrum.power()(row, column), best = wave;
    }
  return best;
}

/// A wave may be an overtone of what is regular.
glm::dvec2 fundamental(const Spectrum& spectrum, glm::dvec2 wave) {
  for (const double divisor : {3.0, 2.0})
    if (const glm::dvec2 lower = wave / divisor;
        spectrum.periods(lower) >= kFewestPeriods && spectrum.share(lower) > 0.3 * spectrum.share(wave))
      return lower;
  return wave;
}

}  // namespace

Lattice findLattice(const AppearanceVectors& vectors, const SourceRegion& region) {
  const Spectrum spectrum(vectors, region);
  Lattice lattice;
  while (lattice.waves.size() < 2) {
    const std::optional<glm::dvec2> found = strongestWave(spectrum, lattice.waves);
    if (!found || spectrum.share(*found) < kWaveShare ||
        spectrum.prominence(*found, lattice.waves) < kProminence)
      break;
    lattice.waves.push_back(spectrum.refined(fundamental(spectrum, *found)));
  }
  return lattice;
}

bool isInPhase(const Lattice& lattice, glm::dvec2 shift, double tolerance) {
  return std::all_of(lattice.waves.begin(), lattice.waves.end(), [&](glm::dvec2 wave) {
    const double periods = glm::dot(wave, shift);
    return std::abs(periods - std::round(periods)) <= tolerance;
  });
}

Lattice fitted(const Lattice& lattice, int width, int height) {
  Lattice result;
  for (const glm::dvec2 wave : lattice.waves)
    result.waves.emplace_back(std::round(wave.x * width) / width, std::round(wave.y * height) / height);
  return result;
}

}  // namespace weft
