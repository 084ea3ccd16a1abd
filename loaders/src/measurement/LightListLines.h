#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// A line of a light list.
struct ListedLight {
  std::string image;  ///< as the list writes it, with '/' between its parts
  glm::dvec3 vector;  ///< to the light, of any length but 0
  std::string where;  ///< the list and the line
};

/// What a `.lp` says, before any image is looked for.
struct LightListLines {
  int count = 0;  ///< what the first line counts; 1 to 1000
  std::vector<ListedLight> lights;
};

/// Reads the text of a light list: in UTF-8 or UTF-16, with any line ends, decimal points or
/// commas. Fails, naming the line, on anything but a count and then an image and three numbers a
/// line: a fourth number is no part of a name that has an extension.
Result<LightListLines> parseLightList(std::string_view bytes, const std::string& where);

/// Whether the name ends in a word that is a number, "coin 12": perhaps one of four.
bool endsInNumber(std::string_view name);

}  // namespace weft
