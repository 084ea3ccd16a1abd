#pragma once

#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

namespace weft::test {

/// Does what is left of the present pass, and all passes after it.
inline void fitRemainingPasses(FieldFit& fit) {
  requireDone(fit.fitRows(0, fit.height(), {}));
  while (!fit.inLastPass()) {
    requireDone(fit.nextPass());
    requireDone(fit.fitRows(0, fit.height(), {}));
  }
}

}  // namespace weft::test
