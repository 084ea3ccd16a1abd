#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace weft {

/// A rectangle of a measurement under some of its lights, ten or so, spread widely.
struct LuminanceWindow {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> views;  ///< unit, tangent frame
  int lights = 0;
  /// stored luminance, `[row][column][view][light]`, row 0 at the top
  std::vector<std::uint8_t> values;
  /// The window is the whole sample, which repeats. Else texels near its border are not used.
  bool wraps = false;
};

/// Where views show the texels of a surface in relief: view i shows the texel X at the pixel
/// X - offsets[i]. Whole texels, x along columns, y up; images repeat.
struct ViewShifts {
  float height = 0.0f;  ///< in texels: offsets are about height (v.x, v.y) / v.z
  std::vector<glm::ivec2> offsets;
};

/// Finds how views have to be shifted so that few components capture what they show of the same
/// texels: first the height that does it best, in half texels between -4 and 8, then whole texels
/// of each view around what that height predicts. A height has to gain 1 % over none. The view
/// nearest to the pole keeps what is predicted. Equal input gives an equal result, with any number
/// of threads.
ViewShifts registerViews(const LuminanceWindow& window);

}  // namespace weft
