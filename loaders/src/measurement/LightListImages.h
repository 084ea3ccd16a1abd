#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "ImageFinder.h"
#include "LightListLines.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

/// An image and its light.
struct LitImage {
  std::string listed;  ///< the image's name in the list
  glm::vec3 light;     ///< unit
  int file = 0;        ///< ImageFinder's
};

/// The image of every light. Warns of counts that are one off and of images that are found by
/// another extension; fails on other counts, on images that are not there, and on the same twice.
Result<std::vector<LitImage>> imagesOfLights(const LightListLines& list, const ImageFinder& finder,
                                             const BtfOptions& options, const std::string& where,
                                             std::vector<std::string>& warnings);

}  // namespace weft
