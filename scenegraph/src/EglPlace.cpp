#include "EglPlace.h"

#include <algorithm>

namespace weft {

std::vector<EglPlace> inOrderOfTrying(std::vector<EglPlace> found, bool softwareOnly) {
  if (softwareOnly) std::erase_if(found, [](const EglPlace& p) { return p.kind == EglPlace::Kind::Card; });
  std::ranges::stable_sort(found, {}, &EglPlace::kind);
  return found;
}

}  // namespace weft
