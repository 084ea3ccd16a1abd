#pragma once

#include "weft/chunks/Chunk.h"

namespace weft {

/// How much of what is behind shines through.
enum class BlendKind {
  Alpha,  ///< by the fragment's alpha, colours not premultiplied
  /// The fragment's second output (`layout(location = 0, index = 1)`) is what it is multiplied by,
  /// each channel for itself; the first is added as it is.
  Tint,
};

/// Lets what is behind shine through. A state with one is drawn after all others, from back to
/// front. Default: no blending.
class BlendChunk : public Chunk {
 public:
  explicit BlendChunk(BlendKind kind = BlendKind::Alpha) : kind_(kind) {}

  Slot kind() const override { return BlendSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk& other) const override {
    return kind_ == static_cast<const BlendChunk&>(other).kind_;
  }

  BlendKind kind_;
};

}  // namespace weft
