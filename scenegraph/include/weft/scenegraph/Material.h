#pragma once

#include "weft/chunks/State.h"

namespace weft {

/// How a surface looks, as far as the scene graph needs to know: the GL state to draw it with.
/// weft::materials has the kinds.
class Material {
 public:
  virtual ~Material() = default;

  /// The chunks by slot. Building it touches no GL.
  virtual const State& state() const = 0;
  /// What decides where the surface keeps light off, drawn with the program variant DEPTH_ONLY;
  /// null where it does everywhere.
  virtual const State* coverage() const { return nullptr; }

 protected:
  Material() = default;
};

}  // namespace weft
