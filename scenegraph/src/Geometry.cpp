#include "weft/scenegraph/Geometry.h"

#include "weft/core/Contract.h"

namespace weft {

Geometry::Geometry(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
  WEFT_EXPECT(mesh_, "a geometry has a mesh");
  bounds_ = boundsOf(*mesh_);
}

}  // namespace weft
