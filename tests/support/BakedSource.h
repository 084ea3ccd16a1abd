#pragma once

#include <algorithm>

#include "TestSupport.h"
#include "weft/baking/BtfBaker.h"
#include "weft/measurement/BtfSource.h"

namespace weft::test {

/// All lights of a view, as BtfBaker::bakeView() leaves them.
inline std::vector<float> bakedView(const BtfBaker& baker, int view) {
  const BakeOptions& options = baker.options();
  std::vector<float> out(options.lights.size() * static_cast<std::size_t>(options.width * options.height) *
                         3);
  baker.bakeView(view, out);
  return out;
}

/// A height field ray-traced into memory, to be fitted without the detour of a file. Small ones
/// only.
class BakedSource : public BtfSource {
 public:
  BakedSource(const HeightField& field, const BakeOptions& options) {
    description_.width = options.width;
    description_.height = options.height;
    description_.views = options.views;
    description_.lights = options.lights;
    description_.encoding = Encoding::Gamma22;
    description_.name = "baked";
    const BtfBaker baker = valueOf(BtfBaker::create(field, options));
    for (std::size_t view = 0; view < options.views.size(); ++view)
      views_.push_back(bakedView(baker, static_cast<int>(view)));
  }

  const BtfDescription& description() const override { return description_; }

  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override {
    WEFT_TRY_VOID(out.allocate(description_, rowCount));
    const std::size_t width = static_cast<std::size_t>(description_.width);
    const std::size_t first = static_cast<std::size_t>(firstRow) * width;
    auto next = out.floats().begin();
    for (std::size_t texel = first; texel < first + static_cast<std::size_t>(rowCount) * width; ++texel)
      for (const std::vector<float>& view : views_)
        for (std::size_t light = 0; light < description_.lights.size(); ++light)
          next = std::copy_n(&view[(light * description_.texels() + texel) * 3], 3, next);
    return {};
  }

 private:
  BtfDescription description_;
  std::vector<std::vector<float>> views_;  ///< [view][light][row][column][rgb]
};

}  // namespace weft::test
