// The numbers of a model whose parameters the hardware filters, where FieldTextures.h packs them:
// weights of components, a byte each, and base colours. Layers are maps that all texels share; the
// model's GLSL file reads them, and defines seenAt(), where the surface in relief is looked up that
// is seen at a place.
#include "field_block.glsl"
#include "footprint.glsl"

layout(binding = sharedParametersUnit) uniform sampler2DArray sharedParameters;
layout(binding = baseColorsUnit) uniform sampler2DArray baseColors;

struct Texel {
  vec3 baseColor;
  int count;  // of the fours of weights that are needed; the others are undefined
  vec4 weights[SHARED_TEXELS];
};

struct Layer {
  int index;
};

// The place with steps as long as the side of the square that is averaged, for GL's filters, which
// go by the longer one.
Place narrowed(Place place) {
  vec2 size = vec2(surfaceSize());
  vec2 across = place.toRight * size, along = place.upwards * size;
  float longest = max(max(dot(across, across), dot(along, along)), 1e-30);
  float share = sqrt(squaredSide(across, along) / longest);
  return Place(place.texcoord, share * place.toRight, share * place.upwards);
}

// How many fours of weights are not all 0 where a pixel covers so much of the surface.
int weightsAt(vec2 toRight, vec2 upwards) {
  vec2 size = vec2(surfaceSize());
  vec2 across = toRight * size, along = upwards * size;
  float level = 0.5 * log2(max(max(dot(across, across), dot(along, along)), 1.0));
  // Rounding takes nothing from a whole level.
  int whole = min(int(level + 1e-3), 15);
  return weightsOfLevels[whole / 4][whole % 4];
}

ivec2 fieldSize() {
  return textureSize(sharedParameters, 0).xy;
}

Layer fetchLayer(Place place, int index) {
  return Layer(index);
}
