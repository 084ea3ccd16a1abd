#include "weft/evaluation/RunParameters.h"

#include "weft/core/FloatImage.h"

namespace weft {

void RunParameters::roundToHalf() {
  for (float& parameter : shared_) parameter = weft::roundToHalf(parameter);
  for (float& parameter : layers_) parameter = weft::roundToHalf(parameter);
}

}  // namespace weft
