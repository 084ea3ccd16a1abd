#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weft/baking/BtfBaker.h"
#include "weft/core/Progress.h"
#include "weft/core/Result.h"

namespace weft {

/// A whole baked BTF in a scratch file, half precision: 8-bit images need a scale that is known
/// only when the last value is, and memory holds one view at a time. For one thread.
class BakedBtf {
 public:
  /// Bakes every view. The scratch file (6 bytes a texel and pair) lies in `folder`, has no name,
  /// and vanishes with the object or the program. Fails where the folder cannot be written to or
  /// the disk is full.
  static Result<BakedBtf> bake(const BtfBaker& baker, const std::filesystem::path& folder,
                               const Progress& progress = {});

  /// The share of all values (three a texel and pair) that exceed 1 when multiplied by `scale`.
  double clippedShare(float scale) const;
  /// The largest scale of at most 1 at which no more than this share of all values exceeds 1.
  float scaleFor(double clippedShare) const;

  /// Writes the values times `scale` as writeBtfZip() does, under the material's name `name`.
  Result<void> writeZip(const std::filesystem::path& path, const std::string& name, float scale,
                        const Progress& progress = {});

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  BakedBtf(File scratch, BakeOptions options);
  Result<void> append(std::span<const float> view, const std::filesystem::path& folder);

  File scratch_;
  BakeOptions options_;
  std::array<std::uint64_t, 0x8000>
      /// of each non-negative half, by its bits, which sort as it does
      counts_{};
  std::vector<std::uint16_t> halfs_;  ///< one view
};

}  // namespace weft
