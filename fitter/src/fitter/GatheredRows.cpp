#include "GatheredRows.h"

#include <cstdint>
#include <cstring>

namespace weft {
namespace {

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

// Each row: how many numbers, then these.
std::vector<std::byte> GatheredRows::contentsOf(RowRange rows) const {
  std::vector<std::byte> contents;
  for (const std::vector<double>& row :
       all().subspan(static_cast<std::size_t>(rows.first), static_cast<std::size_t>(rows.count))) {
    const std::uint64_t size = row.size();
    append(contents, std::as_bytes(std::span(&size, 1)));
    append(contents, std::as_bytes(std::span(row)));
  }
  return contents;
}

bool GatheredRows::take(RowRange rows, std::span<const std::byte> contents) {
  for (int i = rows.first; i < rows.first + rows.count; ++i) {
    std::uint64_t size = 0;
    if (contents.size() < sizeof size) return false;
    std::memcpy(&size, contents.data(), sizeof size);
    contents = contents.subspan(sizeof size);
    if (size > contents.size() / sizeof(double)) return false;
    of(i).resize(size);
    if (size > 0) std::memcpy(of(i).data(), contents.data(), size * sizeof(double));
    contents = contents.subspan(size * sizeof(double));
  }
  return contents.empty();
}

// Fitters alone know how much they gather.
std::size_t GatheredRows::largestContents() const {
  return std::size_t{1} << 40;
}

}  // namespace weft
