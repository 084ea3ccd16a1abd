#include "weft/core/FloatImage.h"

#include <Imath/half.h>

#include <algorithm>
#include <set>

#include "weft/core/Contract.h"

namespace weft {

float roundToHalf(float value) {
  return static_cast<float>(half(value));
}

FloatImage::FloatImage(int width, int height, std::vector<std::string> channels, int layers)
    : width_(width), height_(height), layers_(layers), channels_(std::move(channels)) {
  WEFT_EXPECT(width > 0 && height > 0 && layers > 0 && !channels_.empty(),
              "a FloatImage has a positive size");
  const std::set<std::string> distinct(channels_.begin(), channels_.end());
  WEFT_EXPECT(distinct.size() == channels_.size() && !distinct.contains(""), "channel names are distinct");
  values_.resize(offset(0, 0, layers));
}

std::optional<int> FloatImage::channelIndex(std::string_view name) const {
  const auto found = std::find(channels_.begin(), channels_.end(), name);
  if (found == channels_.end()) return std::nullopt;
  return static_cast<int>(found - channels_.begin());
}

std::span<const float> FloatImage::layerValues(int layer) const {
  return std::span(values_).subspan(offset(0, 0, layer), offset(0, 0, 1));
}

std::span<float> FloatImage::layerValues(int layer) {
  return std::span(values_).subspan(offset(0, 0, layer), offset(0, 0, 1));
}

void FloatImage::roundToHalf() {
  for (float& value : values_) value = weft::roundToHalf(value);
  precision_ = Precision::Half;
}

}  // namespace weft
