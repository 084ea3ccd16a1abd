#include "PictureLayers.h"

#include <algorithm>

namespace weft {
namespace {

struct Layer {
  std::string name;
  ShownValue value;
  std::vector<std::string> channels;
};

const std::vector<Layer>& knownLayers() {
  static const std::vector<Layer> layers{{"normal", ShownValue::Normal, {"X", "Y", "Z"}},
                                         {"depth", ShownValue::Depth, {"Z"}},
                                         {"albedo", ShownValue::Albedo, {"R", "G", "B"}},
                                         {"uv", ShownValue::TextureCoordinates, {"U", "V"}}};
  return layers;
}

/// The first channels of `from` become those of `to` from `first` on.
void copyChannels(const FloatImage& from, int count, FloatImage& to, int first) {
  for (int y = 0; y < to.height(); ++y)
    for (int x = 0; x < to.width(); ++x)
      for (int channel = 0; channel < count; ++channel) to.at(x, y, first + channel) = from.at(x, y, channel);
}

}  // namespace

std::vector<std::string> layerNames() {
  std::vector<std::string> names;
  for (const Layer& layer : knownLayers()) names.push_back(layer.name);
  return names;
}

Result<FloatImage> addLayers(const FloatImage& picture, const std::vector<std::string>& names,
                             GLContext& context, RenderAction& renderer, const Node& root,
                             const Camera& camera) {
  std::vector<std::string> channels = picture.channels();
  std::vector<Layer> layers;
  for (const Layer& layer : knownLayers()) {
    if (std::ranges::find(names, layer.name) == names.end()) continue;
    layers.push_back(layer);
    for (const std::string& channel : layer.channels) channels.push_back(layer.name + "." + channel);
  }
  FloatImage all(picture.width(), picture.height(), channels);
  copyChannels(picture, picture.channelCount(), all, 0);
  const RenderTarget target(picture.width(), picture.height(), Precision::Float);
  int first = picture.channelCount();
  for (const Layer& layer : layers) {
    const RenderOptions options{.background = glm::vec4(0.0f), .shown = layer.value};
    WEFT_TRY_VOID(renderer.render(context, root, camera, target, options));
    const auto count = static_cast<int>(layer.channels.size());
    copyChannels(target.read(context), count, all, first);
    first += count;
  }
  return all;
}

}  // namespace weft
