#pragma once

#include "weft/chunks/Chunk.h"

namespace weft {

/// Lets what is behind shine through by the fragment's alpha, colours not premultiplied. A state
/// with one is drawn after all others, from back to front. Default: no blending.
class BlendChunk : public Chunk {
 public:
  BlendChunk() = default;

  Slot kind() const override { return BlendSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext&, const Chunk&, unsigned) const override {}  // all are alike
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk&) const override { return true; }
};

}  // namespace weft
