#include <algorithm>
#include <array>

#include "weft/core/Checksum.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

std::uint64_t BtfDescription::checksum() const {
  const std::array<std::int64_t, 6> numbers{width,
                                            height,
                                            std::ssize(views),
                                            static_cast<std::int64_t>(encoding),
                                            storedAsBytes ? 1 : 0,
                                            cosineInData ? 1 : 0};
  std::uint64_t checksum = checksumOf(std::as_bytes(std::span(numbers)));
  checksum = checksumOf(std::as_bytes(std::span(views)), checksum);
  return checksumOf(std::as_bytes(std::span(lights)), checksum);
}

Result<std::uint64_t> BtfSource::checksum() const {
  const BtfDescription& measured = description();
  std::uint64_t checksum = measured.checksum();
  const int rowsAtOnce = rowsWithin(std::size_t{256} << 20);
  SampleRows rows;
  for (int first = 0; first < measured.height; first += rowsAtOnce) {
    WEFT_TRY_VOID(readRows(first, std::min(rowsAtOnce, measured.height - first), rows));
    checksum = checksumOf(measured.storedAsBytes ? std::as_bytes(rows.bytes()) : std::as_bytes(rows.floats()),
                          checksum);
  }
  return checksum;
}

}  // namespace weft
