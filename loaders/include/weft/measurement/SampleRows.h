#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "weft/core/Color.h"
#include "weft/core/Result.h"

namespace weft {

struct BtfDescription;

/// All pairs of some rows of a measurement, in memory as it stores them: bytes where its images
/// have 8 bits a channel, else linear floats; a quarter of the memory for most. Filled by
/// BtfSource::readRows(); reading is for any number of threads.
///
/// Pairs are counted `view * lights + light`, rows from the first one that was read.
class SampleRows {
 public:
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  std::size_t pairs() const { return pairs_; }

  /// Linear RGB of one texel and the pairs from `firstPair` on, as many as `out` holds.
  void linear(int row, int column, std::span<glm::vec3> out, std::size_t firstPair = 0) const;
  /// The same, encoded as the measurement stores it.
  void stored(int row, int column, std::span<glm::vec3> out, std::size_t firstPair = 0) const;

  /// For sources: makes room for rows of a measurement, in the memory it has where that suffices.
  /// What they hold is left undefined. Fails where there is no memory.
  Result<void> allocate(const BtfDescription& description, int rows);
  /// For sources: all samples, `[row][column][view][light][rgb]`; bytes() as stored, floats()
  /// linear. Only the one that BtfDescription::storedAsBytes says may be asked for.
  std::span<std::uint8_t> bytes();
  std::span<const std::uint8_t> bytes() const;
  std::span<float> floats();
  std::span<const float> floats() const;

 private:
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };

  std::size_t sampleCount() const {
    return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_) * pairs_ * 3;
  }
  template <class T>
  const T* samplesOf(int row, int column, std::span<glm::vec3> out, std::size_t firstPair) const;

  std::unique_ptr<void, Free> memory_;
  std::size_t memoryBytes_ = 0;
  int rows_ = 0;
  int columns_ = 0;
  std::size_t pairs_ = 0;
  bool storedAsBytes_ = false;
  Encoding encoding_ = Encoding::Linear;
  std::array<float, 256> linearOfByte_{};
};

}  // namespace weft
