#pragma once

#include <zip.h>

#include <memory>

namespace weft {

struct DiscardZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
/// An archive that is left as it was, unless it is released and closed.
using Zip = std::unique_ptr<zip_t, DiscardZip>;

}  // namespace weft
