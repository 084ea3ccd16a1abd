#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// How many bits a value needs in a file or on the GPU. In memory a FloatImage always holds floats.
enum class Precision { Half, Float };

/// Rounds to the nearest half-precision value, to even at ties, as OpenEXR and GL do; too large
/// becomes infinite.
float roundToHalf(float value);

/// A float image with named channels and layers, of any size:
/// `values[layer][row][column][channel]`, row 0 at the top.
///
/// The class that [Meseth 2004] 5.4 asks for: parameters, environments and rendered pictures. Not
/// thread safe while written to.
class FloatImage {
 public:
  FloatImage() = default;
  /// All values 0. Channel names must be distinct and not empty, sizes positive.
  FloatImage(int width, int height, std::vector<std::string> channels, int layers = 1);

  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }
  int channelCount() const { return static_cast<int>(channels_.size()); }
  bool empty() const { return values_.empty(); }
  const std::vector<std::string>& channels() const { return channels_; }
  std::optional<int> channelIndex(std::string_view name) const;

  float& at(int x, int y, int channel, int layer = 0) {
    return values_[offset(x, y, layer) + static_cast<std::size_t>(channel)];
  }
  float at(int x, int y, int channel, int layer = 0) const {
    return values_[offset(x, y, layer) + static_cast<std::size_t>(channel)];
  }
  /// All channels of one texel.
  std::span<float> texel(int x, int y, int layer = 0) {
    return {values_.data() + offset(x, y, layer), channels_.size()};
  }
  std::span<const float> texel(int x, int y, int layer = 0) const {
    return {values_.data() + offset(x, y, layer), channels_.size()};
  }

  std::span<float> values() { return values_; }
  std::span<const float> values() const { return values_; }
  /// `[row][column][channel]` of one layer.
  std::span<const float> layerValues(int layer) const;
  std::span<float> layerValues(int layer);

  /// Half promises that every value is exactly representable as a half.
  Precision precision() const { return precision_; }
  /// Rounds every value to half precision and remembers it.
  void roundToHalf();
  /// For readers of half-precision files, whose values are halfs already.
  void setPrecision(Precision precision) { precision_ = precision; }

  /// Text that travels with the image (EXR string attributes).
  std::map<std::string, std::string> metadata;

 private:
  std::size_t offset(int x, int y, int layer) const {
    return ((static_cast<std::size_t>(layer) * static_cast<std::size_t>(height_) +
             static_cast<std::size_t>(y)) *
                static_cast<std::size_t>(width_) +
            static_cast<std::size_t>(x)) *
           channels_.size();
  }

  int width_ = 0;
  int height_ = 0;
  int layers_ = 0;
  std::vector<std::string> channels_;
  std::vector<float> values_;
  Precision precision_ = Precision::Float;
};

}  // namespace weft
