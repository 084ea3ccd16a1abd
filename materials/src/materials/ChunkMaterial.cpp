#include "weft/materials/ChunkMaterial.h"

#include "weft/chunks/DepthChunk.h"
#include "weft/chunks/RasterChunk.h"

namespace weft {

ChunkMaterial::ChunkMaterial() {
  setChunk(DepthSlot, std::make_shared<DepthChunk>());
  setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::Back));
}

}  // namespace weft
