#pragma once

#include <filesystem>
#include <glm/geometric.hpp>

#include "TestSupport.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft::test {

/// Texels red, green, blue and grey, row by row, brighter for light from
/// +x and less so from +y, seen alike from everywhere: shows a wrong texture or frame at once.
inline ReflectanceField testField() {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  FloatImage shared(2, 2, model->sharedChannels());
  const glm::vec3 colors[] = {{0.8f, 0.1f, 0.1f}, {0.1f, 0.8f, 0.1f}, {0.1f, 0.1f, 0.8f}, {0.7f, 0.7f, 0.7f}};
  for (int texel = 0; texel < 4; ++texel)
    for (int channel = 0; channel < 3; ++channel)
      shared.at(texel % 2, texel / 2, channel) = colors[texel][channel];
  FloatImage views(2, 2, model->layerChannels(), 1);
  for (int texel = 0; texel < 4; ++texel) {
    views.at(texel % 2, texel / 2, 3) = 0.5f;
    views.at(texel % 2, texel / 2, 4) = 0.25f;
    views.at(texel % 2, texel / 2, 5) = 0.75f;
  }
  ReflectanceFieldDescription description;
  description.views = {{0, 0, 1}};
  description.lights = {
      {0, 0, 1}, glm::normalize(glm::vec3(1, 0, 0.2f)), glm::normalize(glm::vec3(0, 1, 0.2f))};
  return valueOf(ReflectanceField::create(model, description, std::move(shared), std::move(views)));
}

}  // namespace weft::test
