#pragma once

#include <memory>

#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Gives everything below it a material. Where groups are nested the outermost wins, so that a
/// whole model can be re-dressed from above; null leaves it to the groups below.
class MaterialGroup : public NodeCore {
 public:
  explicit MaterialGroup(std::shared_ptr<const Material> material) : material_(std::move(material)) {}

  const std::shared_ptr<const Material>& material() const { return material_; }
  void setMaterial(std::shared_ptr<const Material> material) {
    material_ = std::move(material);
    changed();
  }

 private:
  std::shared_ptr<const Material> material_;
};

}  // namespace weft
