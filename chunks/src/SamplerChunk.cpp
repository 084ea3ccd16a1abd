#include "weft/chunks/SamplerChunk.h"

#include "SamplingParameters.h"
#include "weft/chunks/GLName.h"

namespace weft {

void SamplerChunk::activate(GLContext& context, unsigned slot) const {
  auto& sampler = context.objectsOf<GLSampler>(owner_);
  if (!sampler) {
    sampler = createGL<GLSampler>(glCreateSamplers);
    setSampling(sampling_, sampler, glSamplerParameteri);
  }
  glBindSampler(slot - SamplerSlot, sampler);
}

void SamplerChunk::changeFrom(GLContext& context, const Chunk&, unsigned slot) const {
  activate(context, slot);
}

void SamplerChunk::deactivate(GLContext&, unsigned slot) const {
  glBindSampler(slot - SamplerSlot, 0);
}

bool SamplerChunk::isEqual(const Chunk& other) const {
  return sampling_ == static_cast<const SamplerChunk&>(other).sampling_;
}

}  // namespace weft
