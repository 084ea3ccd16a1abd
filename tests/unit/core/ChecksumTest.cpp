#include "weft/core/Checksum.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace weft {
namespace {

std::uint64_t checksumOfBytes(const std::vector<unsigned char>& bytes) {
  return checksumOf(std::as_bytes(std::span(bytes)));
}

TEST(Checksum, ChangesWithEveryByteAndItsPlace) {
  std::vector<unsigned char> bytes(21);
  std::set<std::uint64_t> checksums{checksumOfBytes(bytes)};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = 1;
    EXPECT_TRUE(checksums.insert(checksumOfBytes(bytes)).second) << i;
    bytes[i] = 0;
  }
}

TEST(Checksum, GoesOnFromAnother) {
  const std::vector<unsigned char> bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  const auto all = std::as_bytes(std::span(bytes));
  EXPECT_EQ(checksumOf(all.subspan(8), checksumOf(all.first(8))), checksumOf(all));
}

}  // namespace
}  // namespace weft
