#include "weft/materials/LambertMaterial.h"

#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/shaders/Bindings.h"

namespace weft {

LambertMaterial::LambertMaterial(const LambertOptions& options) {
  ShaderSource source{.vertex = "mesh.vert", .fragment = "lambert.frag"};
  if (options.baseColorTexture) {
    source.defines.emplace_back("BASE_COLOR_TEXTURE", "");
    setChunk(
        textureSlot(bindings::baseColorUnit),
        std::make_shared<TextureChunk>(
            options.baseColorTexture,
            TextureOptions{.filter = TextureFilter::Mipmapped, .wrap = TextureWrap::Repeat, .srgb = true}));
  }
  setChunk(ProgramSlot, std::make_shared<ProgramChunk>(std::move(source)));
  setChunk(uniformSlot(bindings::materialBinding),
           std::make_shared<UniformBlockChunk>(blockBytes(options.baseColor)));
  if (options.doubleSided) setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::None));
}

}  // namespace weft
