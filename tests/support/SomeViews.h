#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "weft/measurement/BtfSource.h"

namespace weft::test {

/// Some views of a measurement, because to fit all would take long.
class SomeViews : public BtfSource {
 public:
  SomeViews(std::shared_ptr<const BtfSource> all, std::vector<int> views)
      : all_(std::move(all)), views_(std::move(views)), description_(all_->description()) {
    description_.storedAsBytes = false;
    description_.views.clear();
    for (const int view : views_)
      description_.views.push_back(all_->description().views[static_cast<std::size_t>(view)]);
  }

  const BtfDescription& description() const override { return description_; }
  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override {
    SampleRows all;
    WEFT_TRY_VOID(all_->readRows(firstRow, rowCount, all));
    WEFT_TRY_VOID(out.allocate(description_, rowCount));
    const std::size_t lights = description_.lights.size();
    std::vector<glm::vec3> samples(lights);
    auto next = out.floats().begin();
    for (int row = 0; row < rowCount; ++row)
      for (int column = 0; column < description_.width; ++column)
        for (const int view : views_) {
          all.linear(row, column, samples, static_cast<std::size_t>(view) * lights);
          for (const glm::vec3& rgb : samples) next = std::copy_n(&rgb.x, 3, next);
        }
    return {};
  }

 private:
  std::shared_ptr<const BtfSource> all_;
  std::vector<int> views_;
  BtfDescription description_;
};

}  // namespace weft::test
