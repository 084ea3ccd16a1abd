#include "weft/scenegraph/Geometry.h"

#include "weft/core/Contract.h"

namespace weft {

Geometry::Geometry(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
  WEFT_EXPECT(mesh_, "a geometry has a mesh");
  for (const glm::vec3 position : mesh_->positions) bounds_.include(position);
}

}  // namespace weft
