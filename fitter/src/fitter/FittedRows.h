#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/evaluation/ErrorMeter.h"

namespace weft {

struct RowRange {
  int first = 0;
  int count = 0;
};

/// The rows of a field while it is being fitted, in memory and in a folder of files, a file for some rows.
///
/// The files let a fit go on after it was stopped, and let several processes share one. They are for the kind
/// of machine that wrote them, not for exchange.
class FittedRows {
 public:
  /// `fingerprint` says everything that decides the numbers: files of another fit are refused.
  FittedRows(int width, int height, const FieldFormula& formula, std::filesystem::path folder,
             std::string fingerprint);

  FloatImage shared;
  FloatImage layers;
  std::vector<SplitErrors> errors;  ///< of texels, row by row

  bool isDone(int row) const { return done_[static_cast<std::size_t>(row)]; }
  void setDone(int firstRow, int count);

  /// The rows that are done and were not given out before, for save(); none where the folder's name is empty.
  std::vector<RowRange> takeUnsaved();
  /// Writes rows to a file.
  Result<void> save(RowRange range) const;
  /// Takes over what is in the folder, which may be missing. Fails on files that are damaged or of another
  /// fit.
  Result<void> load();
  /// Removes the folder.
  void remove() const;

 private:
  Result<void> loadFile(const std::filesystem::path& path);
  std::vector<std::span<std::byte>> bytesOf(RowRange range);

  std::filesystem::path folder_;
  std::string fingerprint_;
  std::vector<bool> done_;
  std::vector<bool> saved_;
};

}  // namespace weft
