#pragma once

#include <memory>

#include "GltfFile.h"
#include "weft/scenegraph/Light.h"

namespace weft {

constexpr const char* kLightExtension = "KHR_lights_punctual";

/// A light of the file.
Result<std::shared_ptr<Light>> lightFrom(const GltfFile& file, int index, std::vector<std::string>& warnings);

}  // namespace weft
