#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>

namespace weft {

/// Floats for SIMD: aligned, zero, and a whole number of the widest vectors.
class AlignedFloats {
 public:
  AlignedFloats() = default;
  explicit AlignedFloats(std::size_t count);

  /// `count` rounded up to whole vectors.
  static std::size_t padded(std::size_t count) { return (count + 15) / 16 * 16; }
  std::size_t size() const { return size_; }
  float* data() { return floats_.get(); }
  const float* data() const { return floats_.get(); }
  float& operator[](std::size_t i) { return floats_[i]; }
  float operator[](std::size_t i) const { return floats_[i]; }

 private:
  std::size_t size_ = 0;
  hwy::AlignedFreeUniquePtr<float[]> floats_;
};

}  // namespace weft
