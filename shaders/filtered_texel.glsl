// The numbers of a model whose parameters the hardware filters, where FieldTextures.h packs them:
// weights of components, a byte each, and base colours. Layers are maps that all texels share; the
// model's GLSL file reads them, and defines seenAt(), where the surface in relief is looked up that
// is seen at a place.
#include "field_block.glsl"

layout(binding = sharedParametersUnit) uniform sampler2DArray sharedParameters;
layout(binding = baseColorsUnit) uniform sampler2DArray baseColors;

struct Texel {
  vec3 baseColor;
  vec4 weights[SHARED_TEXELS];
};

struct Layer {
  int index;
};

ivec2 fieldSize() {
  return textureSize(sharedParameters, 0).xy;
}

Layer fetchLayer(Place place, int index) {
  return Layer(index);
}
