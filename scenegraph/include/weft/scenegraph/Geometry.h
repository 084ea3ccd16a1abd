#pragma once

#include <memory>

#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Mesh.h"
#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Draws a mesh with the material of the outermost MaterialGroup above it. The mesh is immutable,
/// so that many cores and contexts can share it; Node::setCore() shows another one.
class Geometry : public NodeCore {
 public:
  explicit Geometry(std::shared_ptr<const Mesh> mesh);

  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
  /// Around the mesh's vertices, in its own coordinates.
  const Bounds& bounds() const { return bounds_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  Bounds bounds_;
};

}  // namespace weft
