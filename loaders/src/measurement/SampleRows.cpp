#include "weft/measurement/SampleRows.h"

#include <fmt/format.h>

#include "weft/core/Contract.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

Result<void> SampleRows::allocate(const BtfDescription& description, int rows) {
  const std::size_t bytes = static_cast<std::size_t>(rows) * description.rowBytes();
  if (bytes > memoryBytes_) {
    memory_.reset();  // before the larger piece is taken
    memory_.reset(std::malloc(bytes));
    memoryBytes_ = memory_ ? bytes : 0;
  }
  if (bytes > memoryBytes_)
    return fail(fmt::format("there is no memory for {} bytes of samples", bytes), description.name,
                "allow less memory, so that fewer rows are read at once");
  rows_ = rows;
  columns_ = description.width;
  pairs_ = description.views.size() * description.lights.size();
  storedAsBytes_ = description.storedAsBytes;
  encoding_ = description.encoding;
  for (std::size_t i = 0; i < linearOfByte_.size(); ++i)
    linearOfByte_[i] = decode(encoding_, static_cast<float>(i) / 255.0f);
  return {};
}

std::span<const std::uint8_t> SampleRows::bytes() const {
  WEFT_EXPECT(storedAsBytes_, "the samples are bytes");
  return {static_cast<const std::uint8_t*>(memory_.get()), sampleCount()};
}

std::span<std::uint8_t> SampleRows::bytes() {
  WEFT_EXPECT(storedAsBytes_, "the samples are bytes");
  return {static_cast<std::uint8_t*>(memory_.get()), sampleCount()};
}

std::span<const float> SampleRows::floats() const {
  WEFT_EXPECT(!storedAsBytes_, "the samples are floats");
  return {static_cast<const float*>(memory_.get()), sampleCount()};
}

std::span<float> SampleRows::floats() {
  WEFT_EXPECT(!storedAsBytes_, "the samples are floats");
  return {static_cast<float*>(memory_.get()), sampleCount()};
}

template <class T>
const T* SampleRows::samplesOf(int row, int column, std::span<glm::vec3> out, std::size_t firstPair) const {
  WEFT_EXPECT(row >= 0 && row < rows_ && column >= 0 && column < columns_, "the texel was read");
  WEFT_EXPECT(out.size() <= pairs_ && firstPair <= pairs_ - out.size(), "the pairs exist");
  const std::size_t texel =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  return static_cast<const T*>(memory_.get()) + (texel * pairs_ + firstPair) * 3;
}

void SampleRows::linear(int row, int column, std::span<glm::vec3> out, std::size_t firstPair) const {
  if (storedAsBytes_) {
    const std::uint8_t* from = samplesOf<std::uint8_t>(row, column, out, firstPair);
    for (glm::vec3& rgb : out) {
      rgb = {linearOfByte_[from[0]], linearOfByte_[from[1]], linearOfByte_[from[2]]};
      from += 3;
    }
  } else {
    const float* from = samplesOf<float>(row, column, out, firstPair);
    for (glm::vec3& rgb : out) {
      rgb = {from[0], from[1], from[2]};
      from += 3;
    }
  }
}

void SampleRows::stored(int row, int column, std::span<glm::vec3> out, std::size_t firstPair) const {
  if (storedAsBytes_) {
    const std::uint8_t* from = samplesOf<std::uint8_t>(row, column, out, firstPair);
    for (glm::vec3& rgb : out) {
      rgb = glm::vec3(from[0], from[1], from[2]) / 255.0f;
      from += 3;
    }
  } else {
    linear(row, column, out, firstPair);
    for (glm::vec3& rgb : out) rgb = encode(encoding_, rgb);
  }
}

}  // namespace weft
