#pragma once

#include <filesystem>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/measurement/BtfWriter.h"

namespace weft::test {

/// A small cloth of two colours with a soft highlight, 3 x 2 texels, as a measurement in a zip.
inline std::filesystem::path clothZip(const std::filesystem::path& folder, float brightness = 1.0f) {
  const MemoryBtf cloth(3, 2, [=](int x, int y, glm::vec3, glm::vec3 l) {
    const glm::vec3 color = (x + y) % 2 ? glm::vec3(0.6f, 0.3f, 0.2f) : glm::vec3(0.2f, 0.3f, 0.6f);
    return brightness * l.z * (color + glm::vec3(0.2f * l.x * l.x));
  });
  BtfDescription description = cloth.description();
  description.name = "CLOTH";
  const std::filesystem::path zip = folder / "cloth.zip";
  requireDone(writeBtfZip(zip, description,
                          [&](int view, std::span<float> out) { return cloth.readView(view, out); }));
  return zip;
}

}  // namespace weft::test
