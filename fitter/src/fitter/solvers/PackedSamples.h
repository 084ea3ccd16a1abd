#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace weft {

/// Samples as halfs, four in the place of a double: what a pass gathers (FieldFitter.h) are
/// doubles, which are kept and handed on bit by bit. Not for arithmetic.
///
/// How many doubles hold so many samples.
constexpr std::size_t packedSize(std::size_t samples) {
  return (samples + 3) / 4;
}
/// Appends packedSize() doubles; values beyond the range of halfs become its ends.
void packSamples(std::span<const float> values, std::vector<double>& packed);
/// The samples that packSamples() made `packed` of; `packed` holds packedSize() doubles of them.
void unpackSamples(std::span<const double> packed, std::span<float> values);

}  // namespace weft
