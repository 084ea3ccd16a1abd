#include "weft/chunks/Chunk.h"

namespace weft {

void Chunk::changeFrom(GLContext& context, const Chunk& old, unsigned slot) const {
  old.deactivate(context, slot);
  activate(context, slot);
}

}  // namespace weft
