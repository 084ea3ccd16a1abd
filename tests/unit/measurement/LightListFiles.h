#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "Samples.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/io/ImageFile.h"
#include "weft/measurement/BtfSource.h"

namespace weft::test {

/// An image of 3 x 2 pixels whose value tells which one it is.
inline void writeImage(const std::filesystem::path& file, int value) {
  std::filesystem::create_directories(file.parent_path());
  requireDone(writePng(file, imageOf(3, 2, [&](int x, int y, int c) { return value + x + y + c; })));
}

inline std::filesystem::path writeList(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// Two images and a list of them in a fresh folder.
inline std::filesystem::path listOfTwo(const std::string& text) {
  const std::filesystem::path folder = testFolder();
  writeImage(folder / "a.png", 10);
  writeImage(folder / "b.png", 20);
  return writeList(folder / "dirs.lp", text);
}

inline std::string errorOfOpening(const std::filesystem::path& path, const BtfOptions& options = {}) {
  const auto source = openBtf(path, options);
  return source ? "opened" : source.error().message();
}

/// The values that tell the images apart, by light.
inline std::vector<int> imagesOf(const BtfSource& source) {
  const SampleRows rows = allRows(source);
  std::vector<glm::vec3> texel(rows.pairs());
  rows.stored(0, 0, texel);
  std::vector<int> values;
  for (const glm::vec3& rgb : texel) values.push_back(static_cast<int>(std::lround(rgb.x * 255.0f)));
  return values;
}

/// All warnings of a measurement, a line each.
inline std::string warningsOf(const BtfSource& source) {
  std::string all;
  for (const std::string& warning : source.description().warnings) all += warning + "\n";
  return all;
}

}  // namespace weft::test
