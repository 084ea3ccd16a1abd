#pragma once

#include <memory>

#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Gives everything below it a material. Where groups are nested the outermost wins, so that a whole model
/// can be re-dressed from above.
class MaterialGroup : public NodeCore {
 public:
  explicit MaterialGroup(std::shared_ptr<const Material> shared) : material(std::move(shared)) {}

  std::shared_ptr<const Material> material;
};

}  // namespace weft
