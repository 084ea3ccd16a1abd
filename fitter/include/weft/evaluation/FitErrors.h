#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The error of one texel in one space and one measure: sums over its measured pairs.
struct ErrorSums {
  float absolute = 0.0f;
  float squared = 0.0f;
};

/// Index of luminance and RGB in the arrays below.
enum class ErrorMeasure { Luminance, Rgb };
enum class ErrorSpace { Stored, Linear };

/// Values of some pairs, n.l included, linear and as the measurement stores them.
struct PairValues {
  std::span<const glm::vec3> linear;
  std::span<const glm::vec3> stored;
};

/// Errors of one texel over its pairs ([Meseth 2004] eq. 2 before the division). RGB errors are
/// means over the three channels.
struct TexelErrors {
  std::array<std::array<ErrorSums, 2>, 2> sums{};  ///< [space][measure]
  float grazingAbsolute = 0.0f;                    ///< stored luminance, theta_v >= 60 degrees
  std::uint32_t pairs = 0;
  std::uint32_t grazingPairs = 0;
  float peak = 0.0f;  ///< the largest linear value of the data

  /// Adds pairs of one view.
  void add(const PairValues& data, const PairValues& model, bool isGrazing);
};

/// Average, extremes and 95th percentile over texels of eps ([Meseth 2004] eq. 2), and root mean
/// square error over everything.
struct ErrorStatistics {
  double average = 0.0, minimum = 0.0, maximum = 0.0, percentile95 = 0.0;
  double rootMeanSquare = 0.0;
  /// in dB; against a peak of 1 for stored and the data's largest value for linear; infinite for no
  /// error
  double psnr = 0.0;
};

/// The errors of a fit, on luminance and RGB, in stored and linear values.
struct FitErrors {
  std::array<std::array<ErrorStatistics, 2>, 2> statistics{};  ///< [space][measure]
  std::array<double, 2> psnrPeak{1.0, 1.0};                    ///< [space]
  double grazing = 0.0;  ///< eps of stored luminance over theta_v >= 60 degrees
  std::size_t texels = 0;

  const ErrorStatistics& of(ErrorSpace space, ErrorMeasure measure) const {
    return statistics[static_cast<std::size_t>(space)][static_cast<std::size_t>(measure)];
  }
};

/// Sums texels in their order, so that the result is the same for any number of threads.
FitErrors summarize(std::span<const TexelErrors> texels);

/// The fields `epsilon`, `rmse`, `psnr`, `psnr_peak`, `texels` of `weft-fit --json`, and the same
/// again for held-out pairs as `held_out` (null without), as JSON text, without time, host or path.
std::string toJson(const FitErrors& errors, const std::optional<FitErrors>& heldOut = {});

/// The errors as a table of text, `title` in its corner; with a line end.
std::string toText(const std::string& title, const FitErrors& errors);

}  // namespace weft
