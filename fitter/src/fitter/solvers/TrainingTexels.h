#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// The texels of a field from which what all share is fitted: spread at random, the same for every
/// process. Few enough for 40 million samples, and at most 6,000.
class TrainingTexels {
 public:
  TrainingTexels(int width, int height, std::size_t pairs);

  /// How many there are; at least 1 of a field that has any.
  std::size_t count() const { return count_; }
  bool contains(int x, int y) const;

 private:
  std::uint64_t rankOf(int x, int y) const;

  int width_;
  std::size_t count_ = 0;
  std::uint64_t lastRank_ = 0;
};

/// Some lights that are spread widely, as indices into lights that are sorted by polar angle, then
/// azimuth, as those of measurements are.
std::vector<std::size_t> spreadLights(std::size_t lights, std::size_t wanted);

}  // namespace weft
