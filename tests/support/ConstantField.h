#pragma once

#include <filesystem>
#include <glm/vec3.hpp>

#include "TestSupport.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft::test {

/// A field that shows `color` wherever light falls head-on.
inline void writeConstantField(const std::filesystem::path& path, glm::vec3 color) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  FloatImage shared(1, 1, model->sharedChannels());
  for (int channel = 0; channel < 3; ++channel) shared.at(0, 0, channel) = color[channel];
  FloatImage views(1, 1, model->layerChannels(), 1);
  views.at(0, 0, 5) = 1.0f;
  ReflectanceFieldDescription description;
  description.views = description.lights = {{0, 0, 1}};
  requireDone(writeReflectanceField(
      valueOf(ReflectanceField::create(model, description, std::move(shared), std::move(views))), path));
}

}  // namespace weft::test
