#pragma once

#include <optional>
#include <string_view>

namespace weft {

/// A direction as image names write it: polar angle 0..180 and azimuth 0..360 (excluded), in
/// degrees; azimuth 0 at the pole.
struct Angles {
  double theta = 0.0;
  double phi = 0.0;

  auto operator<=>(const Angles&) const = default;
};

/// The directions of the light and the view that an image was taken with.
struct AnglePair {
  Angles light;
  Angles view;

  auto operator<=>(const AnglePair&) const = default;
};

/// Reads `tl`, `pl`, `tv`, `pv`, each followed by a number, in any order from a file's base name:
/// UBO2003's "00008 tl000 pl000 tv030 pv030.jpg", UTIA's underscores, SPECTRAL's
/// "tv7.50_pv-120.00_tl15_pl0". Numbers may have signs and decimals, also behind a comma; azimuths
/// count from 0 to 360 or from -180 to 180. Nothing where one is missing, or a polar angle is
/// negative or above 180.
std::optional<AnglePair> anglesFromName(std::string_view baseName);

}  // namespace weft
