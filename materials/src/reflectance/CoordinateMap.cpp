#include "weft/reflectance/CoordinateMap.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft {
namespace {

Result<void> checkSize(std::string_view what, int width, int height) {
  constexpr int kMost = CoordinateMap::kLargestSide;
  if (width >= 1 && height >= 1 && width <= kMost && height <= kMost) return {};
  return fail(fmt::format("{} of {} x {} texels is not supported", what, width, height), {},
              fmt::format("1 to {} a side", kMost));
}

}  // namespace

Result<CoordinateMap> CoordinateMap::create(int width, int height, int sampleWidth, int sampleHeight,
                                            std::vector<glm::u16vec2> texels, std::string sampleName) {
  WEFT_TRY_VOID(checkSize("a coordinate map", width, height));
  WEFT_TRY_VOID(checkSize("a coordinate map's sample", sampleWidth, sampleHeight));
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texels.size() != count)
    return fail(fmt::format("a coordinate map of {} x {} has {} texels", width, height, texels.size()));
  const auto outside = std::ranges::find_if(
      texels, [&](glm::u16vec2 texel) { return texel.x >= sampleWidth || texel.y >= sampleHeight; });
  if (outside != texels.end()) {
    const auto index = static_cast<std::size_t>(outside - texels.begin());
    const auto columns = static_cast<std::size_t>(width);
    return fail(fmt::format("texel {}, {} of the coordinate map lies outside of its sample of {} x {} texels",
                            index % columns, index / columns, sampleWidth, sampleHeight));
  }
  CoordinateMap map;
  map.width_ = width;
  map.height_ = height;
  map.sampleWidth_ = sampleWidth;
  map.sampleHeight_ = sampleHeight;
  map.texels_ = std::move(texels);
  map.sampleName_ = std::move(sampleName);
  return map;
}

}  // namespace weft
