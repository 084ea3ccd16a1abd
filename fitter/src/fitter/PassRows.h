#pragma once

#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

#include "PartsFolder.h"
#include "RowRange.h"

namespace weft {

/// What a pass of a fit makes of each row, in memory and in a PartsFolder. Rows may be done in
/// several threads while another one saves those that are.
class PassRows {
 public:
  PassRows(const PartsFolder& folder, int pass, int height);
  virtual ~PassRows() = default;

  bool isDone(int row) const;
  /// The first row that is not done; none: the number of rows.
  int firstMissing() const;
  void setDone(RowRange rows);
  /// Writes the rows that are done and not in the folder. For one thread at a time.
  Result<void> save();
  /// Takes over what is in the folder. Fails on files that are damaged or of another fit.
  Result<void> load();

 private:
  /// What a file holds of rows.
  virtual std::vector<std::byte> contentsOf(RowRange rows) const = 0;
  /// Takes rows from a file; false where they are not contentsOf() such rows.
  virtual bool take(RowRange rows, std::span<const std::byte> contents) = 0;
  virtual std::size_t largestContents() const = 0;
  std::vector<RowRange> unsavedRows() const;
  void setSaved(RowRange rows);

  const PartsFolder& folder_;
  int pass_;
  mutable std::mutex mutex_;
  std::vector<bool> done_;
  std::vector<bool> saved_;
};

}  // namespace weft
