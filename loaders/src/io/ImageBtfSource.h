#pragma once

#include <memory>
#include <vector>

#include "FileCollection.h"
#include "weft/core/Image.h"
#include "weft/io/BtfSource.h"

namespace weft {

/// A BTF stored as one 8-bit image a pair of directions, with the angles in the image's name: UBO2003 and
/// UTIA.
class ImageBtfSource : public BtfSource {
 public:
  /// `where` names the collection in failures, `name` the material.
  static Result<std::unique_ptr<ImageBtfSource>> create(std::unique_ptr<FileCollection> files,
                                                        std::string where, std::string name);

  const BtfDescription& description() const override { return description_; }
  Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const override;

 private:
  ImageBtfSource() = default;

  std::string whereOf(int file) const;
  Result<Image> readPair(std::size_t pair) const;

  std::unique_ptr<FileCollection> files_;
  std::string where_;
  BtfDescription description_;
  std::vector<int> fileOfPair_;  ///< [view][light]
};

}  // namespace weft
