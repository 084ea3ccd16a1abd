#pragma once

#include <span>
#include <vector>

#include "PassRows.h"

namespace weft {

/// What each row gave in a gathering pass (FieldFitter::gather()).
class GatheredRows : public PassRows {
 public:
  GatheredRows(const PartsFolder& folder, int pass, int height)
      : PassRows(folder, pass, height), rows_(static_cast<std::size_t>(height)) {}

  std::vector<double>& of(int row) { return rows_[static_cast<std::size_t>(row)]; }
  std::span<const std::vector<double>> all() const { return rows_; }

 private:
  std::vector<std::byte> contentsOf(RowRange rows) const override;
  bool take(RowRange rows, std::span<const std::byte> contents) override;
  std::size_t largestContents() const override;

  std::vector<std::vector<double>> rows_;
};

}  // namespace weft
