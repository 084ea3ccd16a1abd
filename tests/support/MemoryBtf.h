#pragma once

#include <functional>
#include <span>

#include "weft/core/Direction.h"
#include "weft/measurement/BtfSource.h"

namespace weft::test {

/// The 81 directions of UBO2003.
inline std::vector<glm::vec3> ubo2003Sampling() {
  std::vector<glm::vec3> directions;
  const std::pair<int, int> rings[] = {{0, 1}, {15, 6}, {30, 12}, {45, 18}, {60, 20}, {75, 24}};
  for (const auto& [theta, count] : rings)
    for (int i = 0; i < count; ++i) directions.push_back(directionFromDegrees(theta, 360.0 * i / count));
  return directions;
}

/// A BTF that a function defines: linear RGB of texel (x, y) for a view and a light.
class MemoryBtf : public BtfSource {
 public:
  using Function = std::function<glm::vec3(int x, int y, glm::vec3 view, glm::vec3 light)>;

  MemoryBtf(int width, int height, Function function, bool cosineInData = true)
      : function_(std::move(function)) {
    description_.width = width;
    description_.height = height;
    description_.views = description_.lights = ubo2003Sampling();
    description_.encoding = Encoding::Gamma22;
    description_.cosineInData = cosineInData;
    description_.name = "function";
  }

  const BtfDescription& description() const override { return description_; }
  BtfDescription& description() { return description_; }

  /// All lights of one view, `out[light][row][column][rgb]`, as writeBtfZip() asks for them.
  Result<void> readView(int view, std::span<float> out) const {
    std::size_t next = 0;
    for (glm::vec3 light : description_.lights)
      for (int y = 0; y < description_.height; ++y)
        for (int x = 0; x < description_.width; ++x)
          put(function_(x, y, description_.views[static_cast<std::size_t>(view)], light), out, next);
    return {};
  }

  Result<void> readRows(int firstRow, int rowCount, SampleRows& rows) const override {
    WEFT_TRY_VOID(rows.allocate(description_, rowCount));
    const std::span<float> out = rows.floats();
    std::size_t next = 0;
    for (int y = firstRow; y < firstRow + rowCount; ++y)
      for (int x = 0; x < description_.width; ++x)
        for (glm::vec3 view : description_.views)
          for (glm::vec3 light : description_.lights) put(function_(x, y, view, light), out, next);
    return {};
  }

 private:
  static void put(glm::vec3 rgb, std::span<float> out, std::size_t& next) {
    for (int channel = 0; channel < 3; ++channel) out[next++] = rgb[channel];
  }

  BtfDescription description_;
  Function function_;
};

}  // namespace weft::test
