#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace weft {

/// The components of which all texels are sums: a number a pair of view and light each, as few
/// components as asked for, so that what is left over looks smallest on a display (FitWeights.h).
/// `values` are the linear luminance of some texels, n.l included, `[texel][pair]`, finite.
///
/// The result is `[pair][component]`, n.l included as well; the strongest component is first, and
/// over the texels given the weights of each have the root mean square 1 and no correlation.
/// Components beyond the rank of the values are 0. A randomised SVD (Halko, Martinsson, Tropp:
/// *Finding structure with randomness*, 2011) of pairs scaled by the display's weight at their
/// mean, then alternating least squares with each sample's own weight. Equal input gives equal
/// components.
std::vector<float> fitComponentBasis(std::span<const float> values, std::size_t pairs,
                                     std::size_t components);

}  // namespace weft
