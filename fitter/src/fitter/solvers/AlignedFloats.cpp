#include "solvers/AlignedFloats.h"

#include <algorithm>

namespace weft {

AlignedFloats::AlignedFloats(std::size_t count)
    : size_(padded(count)), floats_(hwy::AllocateAligned<float>(size_)) {
  std::fill_n(floats_.get(), size_, 0.0f);
}

}  // namespace weft
