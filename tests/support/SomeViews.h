#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "weft/io/BtfSource.h"

namespace weft::test {

/// Some views of a measurement, because to fit all would take long.
class SomeViews : public BtfSource {
 public:
  SomeViews(std::shared_ptr<const BtfSource> all, std::vector<int> views)
      : all_(std::move(all)), views_(std::move(views)), description_(all_->description()) {
    description_.views.clear();
    for (const int view : views_)
      description_.views.push_back(all_->description().views[static_cast<std::size_t>(view)]);
  }

  const BtfDescription& description() const override { return description_; }
  Result<void> readView(int view, std::span<float> out) const override {
    return all_->readView(views_[static_cast<std::size_t>(view)], out);
  }
  Result<void> readRows(int firstRow, int rowCount, std::span<float> out) const override {
    const std::size_t lights = description_.lights.size();
    const std::size_t width = static_cast<std::size_t>(description_.width);
    const std::size_t first = static_cast<std::size_t>(firstRow) * width;
    const std::size_t count = static_cast<std::size_t>(rowCount) * width;
    std::vector<float> images(lights * description_.texels() * 3);
    for (std::size_t view = 0; view < views_.size(); ++view) {
      WEFT_TRY_VOID(readView(static_cast<int>(view), images));
      for (std::size_t light = 0; light < lights; ++light)
        for (std::size_t texel = 0; texel < count; ++texel)
          std::copy_n(&images[(light * description_.texels() + first + texel) * 3], 3,
                      &out[((texel * views_.size() + view) * lights + light) * 3]);
    }
    return {};
  }

 private:
  std::shared_ptr<const BtfSource> all_;
  std::vector<int> views_;
  BtfDescription description_;
};

}  // namespace weft::test
