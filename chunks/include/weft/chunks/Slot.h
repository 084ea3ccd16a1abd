#pragma once

#include "weft/core/Contract.h"

namespace weft {

/// The places in a State that a chunk can take, each one independent piece of GL state. A kind with
/// several places (textures) starts at its enumerator.
enum Slot : unsigned {
  ProgramSlot,
  BlendSlot,
  DepthSlot,
  RasterSlot,
  PolygonOffsetSlot,
  TextureSlot,                     ///< + texture unit 0..31
  SamplerSlot = TextureSlot + 32,  ///< + texture unit 0..31
  /// + uniform block binding 0..7; RenderAction keeps 0 for itself
  UniformSlot = SamplerSlot + 32,
  StorageSlot = UniformSlot + 8,  ///< + storage block binding 0..7
  SlotCount = StorageSlot + 8,
};

/// The slot of `layout(binding = unit) uniform sampler...`.
constexpr unsigned textureSlot(unsigned unit) {
  WEFT_EXPECT(unit < SamplerSlot - TextureSlot, "texture units are 0..31");
  return TextureSlot + unit;
}

/// The slot of what the texture in textureSlot(unit) is sampled with.
constexpr unsigned samplerSlot(unsigned unit) {
  WEFT_EXPECT(unit < UniformSlot - SamplerSlot, "texture units are 0..31");
  return SamplerSlot + unit;
}

/// The slot of `layout(std140, binding = binding) uniform`.
constexpr unsigned uniformSlot(unsigned binding) {
  WEFT_EXPECT(binding < StorageSlot - UniformSlot, "uniform bindings are 0..7");
  return UniformSlot + binding;
}

/// The slot of `layout(std430, binding = binding) buffer`.
constexpr unsigned storageSlot(unsigned binding) {
  WEFT_EXPECT(binding < SlotCount - StorageSlot, "storage bindings are 0..7");
  return StorageSlot + binding;
}

/// The first slot of the kind that `slot` belongs to.
constexpr Slot slotKind(unsigned slot) {
  WEFT_EXPECT(slot < SlotCount, "no such slot");
  if (slot >= StorageSlot) return StorageSlot;
  if (slot >= UniformSlot) return UniformSlot;
  if (slot >= SamplerSlot) return SamplerSlot;
  if (slot >= TextureSlot) return TextureSlot;
  return static_cast<Slot>(slot);
}

}  // namespace weft
