#pragma once

#include <memory>
#include <string>
#include <vector>

#include "FileCollection.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

/// A BTF with one image a pair of directions, all read with as many bits as the first: 8, or 16.
class ImageBtfSource : public BtfSource {
 public:
  /// `description` lacks the size, which the first image has; `fileOfPair[view][light]` are indices
  /// into `files`; `where` names the measurement in failures.
  static Result<std::unique_ptr<BtfSource>> create(BtfDescription description,
                                                   std::unique_ptr<FileCollection> files,
                                                   std::vector<int> fileOfPair, std::string where);

  const BtfDescription& description() const override { return description_; }
  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override;
  Result<std::uint64_t> checksum() const override;

 private:
  ImageBtfSource() = default;

  std::string whereOf(int file) const;
  /// All pairs of some rows to `out`, by way of decoded images of such values.
  template <class Value, class Sample, class Convert>
  Result<void> readSamples(int firstRow, int rowCount, Sample* out, const Convert& convert) const;

  BtfDescription description_;
  std::unique_ptr<FileCollection> files_;
  std::vector<int> fileOfPair_;
  std::vector<float> linearOfWord_;  ///< of 16-bit images
  std::string where_;
};

}  // namespace weft
