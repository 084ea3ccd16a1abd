#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "weft/core/Contract.h"
#include "weft/reflectance/FieldFormula.h"

namespace weft {

/// The parameters of the texels of a TexelRun, as a field stores them; 0 at first.
class RunParameters {
 public:
  RunParameters(const FieldFormula& formula, int texels)
      : texels_(static_cast<std::size_t>(texels)),
        shared_(texels_ * formula.model().sharedChannels().size()),
        layers_(texels_ * static_cast<std::size_t>(formula.storedLayers()) *
                formula.model().layerChannels().size()) {}

  int size() const { return static_cast<int>(texels_); }
  /// The shared channels of a texel: its base colour, then the model's shared numbers.
  std::span<float> shared(int texel) { return partOf<float>(shared_, texel); }
  std::span<const float> shared(int texel) const { return partOf<const float>(shared_, texel); }
  /// `[layer][channel]` of a texel.
  std::span<float> layers(int texel) { return partOf<float>(layers_, texel); }
  std::span<const float> layers(int texel) const { return partOf<const float>(layers_, texel); }
  /// Rounds all to half precision.
  void roundToHalf();

 private:
  template <class Float>
  std::span<Float> partOf(std::span<Float> all, int texel) const {
    WEFT_EXPECT(texel >= 0 && texel < size(), "the run has the texel");
    const std::size_t each = all.size() / texels_;
    return all.subspan(static_cast<std::size_t>(texel) * each, each);
  }

  std::size_t texels_;
  std::vector<float> shared_;
  std::vector<float> layers_;
};

}  // namespace weft
