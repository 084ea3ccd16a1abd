#pragma once

#include <cstddef>
#include <span>

#include "weft/evaluation/SampleWindow.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"
#include "weft/reflectance/BoxAverages.h"

namespace weft {

/// A measurement at half its sides, rounded down, at least 1: linear averages of the boxes that
/// coarser texels cover, kept as the measurement stores samples. What coarser levels are fitted to.
/// The finer one must outlive it.
class HalvedBtf : public BtfSource {
 public:
  /// Of the texels that `crop` names. Reads finer rows within `memory` bytes at once.
  HalvedBtf(const BtfSource& finer, const Crop& crop, std::size_t memory);

  const BtfDescription& description() const override { return description_; }
  /// Costs what reading the finer rows does, unless all are kept.
  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override;
  /// Keeps all rows in memory if they take at most half of `memory`.
  Result<void> keep();
  /// The same, made from all finer rows, where both together fit into `memory`.
  Result<void> keepFrom(const SampleWindow& finer);

 private:
  std::size_t bytes() const;
  BoxCover finerRows(int row) const;
  void copyRows(int firstRow, int rowCount, SampleRows& out) const;
  void average(const SampleWindow& finer, int row, int toRow, SampleRows& out) const;
  std::vector<glm::vec3> averageOf(const SampleWindow& finer, const BoxCover& rows, int column) const;

  const BtfSource& finer_;
  Crop crop_;
  std::size_t memory_;
  BtfDescription description_;
  SampleRows kept_;  ///< all rows, or none
};

}  // namespace weft
