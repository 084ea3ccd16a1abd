#include "weft/scene_io/RectangleTextureLoader.h"

#include "weft/core/Contract.h"
#include "weft/io/ExrFile.h"

namespace weft {

Result<std::shared_ptr<TextureChunk>> loadRectangleTexture(const std::filesystem::path& path,
                                                           const std::vector<std::string>& channels) {
  WEFT_EXPECT(!channels.empty() && channels.size() <= 4, "a texture has 1 to 4 channels");
  WEFT_TRY(const FloatImage file, readExr(path));
  FloatImage image(file.width(), file.height(), channels);
  image.setPrecision(file.precision());
  for (int channel = 0; channel < image.channelCount(); ++channel) {
    const std::string& name = channels[static_cast<std::size_t>(channel)];
    const std::optional<int> source = file.channelIndex(name);
    if (!source) return fail("the image has no channel \"" + name + "\"", path.string());
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) image.at(x, y, channel) = file.at(x, y, *source);
  }
  return std::make_shared<TextureChunk>(std::make_shared<const FloatImage>(std::move(image)),
                                        TextureOptions{.shape = TextureShape::Rectangle});
}

}  // namespace weft
