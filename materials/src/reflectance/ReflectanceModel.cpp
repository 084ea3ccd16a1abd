#include "weft/reflectance/ReflectanceModel.h"

#include "weft/core/Contract.h"

namespace weft {
namespace {

void append(std::vector<std::string>& channels, const std::vector<std::string>& numbers, int colorChannels) {
  if (colorChannels == 1) {
    channels.insert(channels.end(), numbers.begin(), numbers.end());
    return;
  }
  for (const char* suffix : {".R", ".G", ".B"})
    for (const std::string& number : numbers) channels.push_back(number + suffix);
}

// Numbers a colour channel, of the shared ones or a layer's.
std::size_t numbersOf(std::size_t channels, int colorChannels) {
  const auto count = static_cast<std::size_t>(colorChannels);
  WEFT_EXPECT(channels % count == 0, "every colour channel has the model's numbers");
  return channels / count;
}

}  // namespace

ReflectanceModel::ReflectanceModel(ModelOptions options)
    : options_(std::move(options)),
      colorChannels_(options_.has("color") && options_.word("color") == "rgb" ? 3 : 1) {}

Result<std::shared_ptr<const ReflectanceModel>> ReflectanceModel::bind(
    std::shared_ptr<const FieldTables>) const {
  contractBroken(__FILE__, __LINE__, "the model has tables");
}

const Registration& ReflectanceModel::registration() const {
  static const Registration kNone;
  return kNone;
}

void ReflectanceModel::evaluateSampled(std::span<const float>, std::span<const float>,
                                       std::span<const glm::vec3>, glm::vec3, std::span<glm::vec3>) const {
  contractBroken(__FILE__, __LINE__, "the model samples its layers");
}

std::vector<std::string> ReflectanceModel::sharedChannels() const {
  std::vector<std::string> channels{"R", "G", "B"};
  append(channels, sharedParameters(), colorChannels_);
  return channels;
}

std::vector<std::string> ReflectanceModel::layerChannels() const {
  std::vector<std::string> channels;
  append(channels, layerParameters(), colorChannels_);
  return channels;
}

glm::vec3 ReflectanceModel::evaluateColor(std::span<const float> shared, std::span<const float> layer,
                                          glm::vec3 light, glm::vec3 view) const {
  WEFT_EXPECT(shared.size() >= 3, "shared numbers begin with the base colour");
  const glm::vec3 baseColor(shared[0], shared[1], shared[2]);
  shared = shared.subspan(3);
  if (colorChannels_ == 1) return evaluate(shared, layer, light, view) * baseColor;
  const std::size_t sharedCount = numbersOf(shared.size(), 3);
  const std::size_t layerCount = numbersOf(layer.size(), 3);
  glm::vec3 color;
  for (std::size_t c = 0; c < 3; ++c)
    color[static_cast<int>(c)] = evaluate(shared.subspan(c * sharedCount, sharedCount),
                                          layer.subspan(c * layerCount, layerCount), light, view);
  return color * baseColor;
}

glm::vec3 ReflectanceModel::underEnvironment(std::span<const float>, std::span<const float>, glm::vec3,
                                             const EnvironmentIntegrals&) const {
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
  WEFT_EXPECT(shared.size() >= 3, "shared numbers begin with the base colour");
  const glm::vec3 baseColor(shared[0], shared[1], shared[2]);
  const auto channels = static_cast<std::size_t>(colorChannels_);
  const std::size_t sharedCount = numbersOf(shared.size() - 3, colorChannels_);
  const std::size_t layerCount = numbersOf(layer.size(), colorChannels_);
  WEFT_EXPECT(colors.size() == lights.size(), "there is room for a colour a light");
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
                                                  glm::vec3 view, const EnvironmentIntegrals& light) const {
  WEFT_EXPECT(shared.size() >= 3, "shared numbers begin with the base colour");
  const glm::vec3 baseColor(shared[0], shared[1], shared[2]);
  const auto channels = static_cast<std::size_t>(colorChannels_);
  const std::size_t sharedCount = numbersOf(shared.size() - 3, colorChannels_);
  const std::size_t layerCount = numbersOf(layer.size(), colorChannels_);
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

}  // namespace weft
