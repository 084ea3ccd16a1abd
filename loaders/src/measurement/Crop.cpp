#include "weft/measurement/Crop.h"

#include <fmt/format.h>

namespace weft {

Result<Crop> checkedCrop(const std::optional<Crop>& wanted, const BtfDescription& source) {
  if (!wanted) return Crop{0, 0, source.width, source.height};
  const Crop& c = *wanted;
  if (c.x < 0 || c.y < 0 || c.width < 1 || c.height < 1 || c.width > source.width - c.x ||
      c.height > source.height - c.y)
    return fail(fmt::format("the crop {} {} {} {} is not inside the {} x {} texels", c.x, c.y, c.width,
                            c.height, source.width, source.height));
  return c;
}

}  // namespace weft
