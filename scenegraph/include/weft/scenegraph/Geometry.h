#pragma once

#include <memory>

#include "weft/scenegraph/Mesh.h"
#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Draws a mesh with the material of the outermost MaterialGroup above it. The mesh is immutable, so that
/// many cores and contexts can share it.
class Geometry : public NodeCore {
 public:
  explicit Geometry(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {}

  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
};

}  // namespace weft
