#pragma once

#include <memory>

#include "weft/chunks/Chunk.h"
#include "weft/chunks/Sampling.h"

namespace weft {

/// How the texture on a unit is sampled, instead of as its own options say: materials that repeat
/// an image and materials that clamp it then share one TextureChunk. Default: as the texture says.
///
/// TextureFilter::Mipmapped asks for a texture that was made with it.
class SamplerChunk : public Chunk {
 public:
  explicit SamplerChunk(const Sampling& sampling) : sampling_(sampling) {}

  Slot kind() const override { return SamplerSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk& other) const override;

  Sampling sampling_;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

}  // namespace weft
