#pragma once

namespace weft {

struct RowRange {
  int first = 0;
  int count = 0;
};

}  // namespace weft
