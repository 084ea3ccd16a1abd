#include "weft/reflectance/ReflectanceModel.h"

#include "weft/core/Contract.h"

namespace weft {
namespace {

void append(std::vector<std::string>& channels, const std::vector<std::string>& numbers, FitColor color) {
  if (color == FitColor::Luminance) {
    channels.insert(channels.end(), numbers.begin(), numbers.end());
    return;
  }
  for (const char* suffix : {".R", ".G", ".B"})
    for (const std::string& number : numbers) channels.push_back(number + suffix);
}

}  // namespace

std::vector<std::string> ReflectanceModel::sharedChannels() const {
  std::vector<std::string> channels{"R", "G", "B"};
  append(channels, sharedNumbers(), description_.color);
  return channels;
}

std::vector<std::string> ReflectanceModel::layerChannels() const {
  std::vector<std::string> channels;
  append(channels, layerNumbers(), description_.color);
  return channels;
}

glm::vec3 ReflectanceModel::evaluateColor(std::span<const float> shared, std::span<const float> layer,
                                          glm::vec3 light, glm::vec3 view) const {
  const glm::vec3 baseColor(shared[0], shared[1], shared[2]);
  shared = shared.subspan(3);
  if (description_.color == FitColor::Luminance) return evaluate(shared, layer, light, view) * baseColor;
  const std::size_t sharedCount = shared.size() / 3;
  const std::size_t layerCount = layer.size() / 3;
  glm::vec3 color;
  for (std::size_t c = 0; c < 3; ++c)
    color[static_cast<int>(c)] = evaluate(shared.subspan(c * sharedCount, sharedCount),
                                          layer.subspan(c * layerCount, layerCount), light, view);
  return color * baseColor;
}

glm::vec3 ReflectanceModel::underEnvironment(std::span<const float>, std::span<const float>, glm::vec3,
                                             const SurfaceLight&) const {
  contractBroken(__FILE__, __LINE__, "the model integrates environments");
}

void ReflectanceModel::evaluateLights(std::span<const float> shared, std::span<const float> layer,
                                      std::span<const glm::vec3> lights, glm::vec3 view,
                                      std::span<float> values) const {
  for (std::size_t i = 0; i < lights.size(); ++i) values[i] = evaluate(shared, layer, lights[i], view);
}

void ReflectanceModel::evaluateColors(std::span<const float> shared, std::span<const float> layer,
                                      std::span<const glm::vec3> lights, glm::vec3 view,
                                      std::span<glm::vec3> colors) const {
  const glm::vec3 baseColor(shared[0], shared[1], shared[2]);
  const auto channels = static_cast<std::size_t>(colorChannels());
  const std::size_t sharedCount = (shared.size() - 3) / channels;
  const std::size_t layerCount = layer.size() / channels;
  std::vector<float> values(lights.size());
  for (std::size_t c = 0; c < channels; ++c) {
    evaluateLights(shared.subspan(3 + c * sharedCount, sharedCount),
                   layer.subspan(c * layerCount, layerCount), lights, view, values);
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (channels == 1)
        colors[i] = values[i] * baseColor;
      else
        colors[i][static_cast<int>(c)] = values[i] * baseColor[static_cast<int>(c)];
  }
}

glm::vec3 ReflectanceModel::colorUnderEnvironment(std::span<const float> shared, std::span<const float> layer,
                                                  glm::vec3 view, const SurfaceLight& light) const {
  const glm::vec3 baseColor(shared[0], shared[1], shared[2]);
  const auto channels = static_cast<std::size_t>(colorChannels());
  const std::size_t sharedCount = (shared.size() - 3) / channels;
  const std::size_t layerCount = layer.size() / channels;
  glm::vec3 value(0.0f);
  for (std::size_t c = 0; c < channels; ++c) {
    const glm::vec3 ofChannel = underEnvironment(shared.subspan(3 + c * sharedCount, sharedCount),
                                                 layer.subspan(c * layerCount, layerCount), view, light);
    if (channels == 1)
      value = ofChannel;
    else
      value[static_cast<int>(c)] = ofChannel[static_cast<int>(c)];
  }
  return value * baseColor;
}

int sharedTexels(const ReflectanceModel& model) {
  return (3 + static_cast<int>(model.sharedNumbers().size()) + 3) / 4;
}

int layerTexels(const ReflectanceModel& model) {
  return (static_cast<int>(model.layerNumbers().size()) + 3) / 4;
}

}  // namespace weft
