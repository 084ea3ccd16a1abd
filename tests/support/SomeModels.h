#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <span>
#include <string>
#include <vector>

#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/reflectance/LodModel.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft::test {

/// Every model of Weft with the standard of its options, and with all of them as far from it as
/// they go: numbers at their smallest, words at the last. Tests of what holds for all models walk
/// these.
inline std::vector<ModelDescription> someModels() {
  std::vector<ModelDescription> models;
  const ModelRegistry registry = ModelRegistry::builtin();
  for (const ModelType& type : registry.types()) {
    models.push_back(valueOf(registry.create({.name = type.name}))->description());
    ModelDescription other{.name = type.name};
    for (const ModelOption& option : type.options)
      other.options[option.name] =
          option.words.empty() ? OptionValue(option.smallest) : option.words.back().word;
    if (!type.options.empty()) models.push_back(other);
  }
  return models;
}

/// A model as the name of a test: "rfnl_rgb_1_per_view".
inline std::string nameOf(const ModelDescription& model) {
  std::string name = model.name;
  for (const auto& [option, value] : model.options) name += "_" + textOf(value);
  std::ranges::replace(name, '-', '_');
  return name;
}

inline FloatImage unevenNumbers(int width, int height, const std::vector<std::string>& channels, int layers,
                                Precision precision) {
  FloatImage image(width, height, channels, layers);
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = std::sin(0.37f * static_cast<float>(i)) + 1.1f;
  if (precision == Precision::Half) image.roundToHalf();
  return image;
}

/// What a GPU keeps of base colours and of parameters that it filters.
inline void roundAsFiltered(FloatImage& shared) {
  for (int y = 0; y < shared.height(); ++y)
    for (int x = 0; x < shared.width(); ++x) {
      const std::span<float> texel = shared.texel(x, y);
      const glm::vec3 color =
          glm::unpackF3x9_E1x5(glm::packF3x9_E1x5(glm::vec3(texel[0], texel[1], texel[2])));
      for (int c = 0; c < 3; ++c) texel[static_cast<std::size_t>(c)] = color[c];
      for (float& number : texel.subspan(3)) number = std::round(60.0f * (number - 1.0f)) / 127.0f;
    }
}

/// Tables of a model, every number another; of one level where it sums them.
inline FieldTables unevenTables(const ReflectanceModel& model, int views) {
  constexpr int kMapSize = 5;
  FieldTables tables;
  for (const ModelTable& table : model.tables()) {
    const bool isRegistration = table.name == "registration";
    const bool isMap = !isRegistration && table.width == 0;
    const int width = isRegistration ? views : isMap ? kMapSize * views : table.width;
    const int height = table.height > 0 ? table.height : isMap ? kMapSize : views;
    tables[table.name] = unevenNumbers(width, height, table.channels, 1, Precision::Half);
  }
  if (model.summedLevels() > 0) tables.at("mean").at(0, 0, LodModel::Levels) = 1.0f;
  return tables;
}

/// A field of four views and five lights whose every number is another, so that a mix-up of texels,
/// layers or channels shows.
inline ReflectanceField unevenField(const ModelDescription& description, int width, int height,
                                    Precision precision = Precision::Half) {
  const auto model = valueOf(ModelRegistry::builtin().create(description));
  ReflectanceFieldDescription about;
  about.views = {directionFromDegrees(0, 0), directionFromDegrees(33, 10), directionFromDegrees(60, 134),
                 directionFromDegrees(75, 271)};
  about.lights = {directionFromDegrees(0, 0), directionFromDegrees(50, 12), directionFromDegrees(50, 140),
                  directionFromDegrees(50, 250), directionFromDegrees(75, 77)};
  about.hasCosine = model->containsCosine();
  about.source = "uneven";
  const int layers = valueOf(FieldFormula::create(model, about)).storedLayers();
  FieldLevel level{unevenNumbers(width, height, model->sharedChannels(), 1, precision), {}};
  if (model->filtersParameters() || model->summedLevels() > 0) roundAsFiltered(level.shared);
  if (layers > 0) level.layers = unevenNumbers(width, height, model->layerChannels(), layers, precision);
  return valueOf(ReflectanceField::create(model, about, {level},
                                          unevenTables(*model, static_cast<int>(about.views.size()))));
}

}  // namespace weft::test
