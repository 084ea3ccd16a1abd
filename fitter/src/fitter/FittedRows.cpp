#include "FittedRows.h"

#include <algorithm>
#include <cstring>

namespace weft {

FittedRows::FittedRows(const PartsFolder& folder, int pass, int width, int height,
                       const FieldFormula& formula)
    : PassRows(folder, pass, height),
      shared(width, height, formula.model().sharedChannels()),
      errors(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  if (formula.storedLayers() > 0)
    layers = FloatImage(width, height, formula.model().layerChannels(), formula.storedLayers());
}

void FittedRows::put(int x, int y, const RunParameters& parameters) {
  const auto channels = static_cast<std::size_t>(layers.channelCount());
  for (int i = 0; i < parameters.size(); ++i) {
    std::ranges::copy(parameters.shared(i), shared.texel(x + i, y).begin());
    for (int layer = 0; layer < layers.layers(); ++layer)
      std::ranges::copy(parameters.layers(i).subspan(static_cast<std::size_t>(layer) * channels, channels),
                        layers.texel(x + i, y, layer).begin());
  }
}

std::span<SplitErrors> FittedRows::errorsAt(int x, int y, int texels) {
  const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(shared.width());
  return std::span(errors).subspan(first + static_cast<std::size_t>(x), static_cast<std::size_t>(texels));
}

std::vector<std::span<std::byte>> FittedRows::bytesOf(RowRange rows) {
  std::vector<std::span<std::byte>> bytes;
  const auto add = [&](auto values, std::size_t valuesOfRow) {
    bytes.push_back(
        std::as_writable_bytes(values.subspan(static_cast<std::size_t>(rows.first) * valuesOfRow,
                                              static_cast<std::size_t>(rows.count) * valuesOfRow)));
  };
  const auto width = static_cast<std::size_t>(shared.width());
  add(shared.values(), width * static_cast<std::size_t>(shared.channelCount()));
  for (int layer = 0; layer < layers.layers(); ++layer)
    add(layers.layerValues(layer), width * static_cast<std::size_t>(layers.channelCount()));
  add(std::span(errors), width);
  return bytes;
}

std::vector<std::byte> FittedRows::contentsOf(RowRange rows) const {
  std::vector<std::byte> contents;
  for (const std::span<std::byte> bytes : const_cast<FittedRows*>(this)->bytesOf(rows))
    contents.insert(contents.end(), bytes.begin(), bytes.end());
  return contents;
}

bool FittedRows::take(RowRange rows, std::span<const std::byte> contents) {
  const std::vector<std::span<std::byte>> to = bytesOf(rows);
  std::size_t wanted = 0;
  for (const std::span<std::byte> bytes : to) wanted += bytes.size();
  if (contents.size() != wanted) return false;
  for (const std::span<std::byte> bytes : to) {
    std::memcpy(bytes.data(), contents.data(), bytes.size());
    contents = contents.subspan(bytes.size());
  }
  return true;
}

std::size_t FittedRows::largestContents() const {
  return shared.values().size_bytes() + layers.values().size_bytes() + errors.size() * sizeof(SplitErrors);
}

}  // namespace weft
