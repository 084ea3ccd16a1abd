#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "TestSupport.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft::test {

/// A field that shows `color` wherever light falls head-on.
inline void writeConstantField(const std::filesystem::path& path, glm::vec3 color, int width = 1,
                               int height = 1, const std::vector<glm::vec3>& views = {{0, 0, 1}}) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  FloatImage shared(width, height, model->sharedChannels());
  FloatImage layers(width, height, model->layerChannels(), static_cast<int>(views.size()));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (int channel = 0; channel < 3; ++channel) shared.at(x, y, channel) = color[channel];
      for (int layer = 0; layer < layers.layers(); ++layer) layers.at(x, y, 5, layer) = 1.0f;
    }
  ReflectanceFieldDescription description;
  description.views = views;
  description.lights = {{0, 0, 1}};
  requireDone(writeReflectanceField(
      valueOf(ReflectanceField::create(model, description, std::move(shared), std::move(layers))), path));
}

}  // namespace weft::test
