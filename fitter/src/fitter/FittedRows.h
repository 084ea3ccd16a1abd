#pragma once

#include <vector>

#include "PassRows.h"
#include "weft/core/FloatImage.h"
#include "weft/evaluation/ErrorMeter.h"

namespace weft {

/// The rows of a field while it is being fitted: parameters and errors.
class FittedRows : public PassRows {
 public:
  FittedRows(const PartsFolder& folder, int pass, int width, int height, const FieldFormula& formula);

  /// Puts in a run of texels.
  void put(int x, int y, const RunParameters& parameters);
  /// The errors of texels of a row.
  std::span<SplitErrors> errorsAt(int x, int y, int texels);

  FloatImage shared;
  FloatImage layers;
  std::vector<SplitErrors> errors;  ///< of texels, row by row

 private:
  std::vector<std::byte> contentsOf(RowRange rows) const override;
  bool take(RowRange rows, std::span<const std::byte> contents) override;
  std::size_t largestContents() const override;
  std::vector<std::span<std::byte>> bytesOf(RowRange rows);
};

}  // namespace weft
