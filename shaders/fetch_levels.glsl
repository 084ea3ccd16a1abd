// The numbers of a model that sums levels, as FieldTextures.h packs them: a byte each. Levels below
// the level of detail are not fetched (LevelSum.h).
#include "field_block.glsl"

layout(binding = sharedParametersUnit) uniform sampler2DArray sharedParameters;

struct Texel {
  int first;                              // the finest level that counts
  vec4 weights[LEVELS * SHARED_TEXELS];  // of all from there
};

struct Layer {
  int index;
};

ivec2 fieldSize() {
  return textureSize(sharedParameters, 0).xy;
}

// Texels of these models stay where they are.
Place seenAt(Place place, LayerWeights layers, vec3 view) {
  return place;
}

Texel fetchTexel(Place place) {
  float detail = clamp(place.detail, 0.0, float(LEVELS - 1));
  Texel texel;
  texel.first = int(detail);
  int level = texel.first;
  do {
    float share = clamp(1.0 - detail + float(level), 0.0, 1.0);
    for (int i = 0; i < SHARED_TEXELS; ++i)
      texel.weights[level * SHARED_TEXELS + i] =
          share * textureLod(sharedParameters, vec3(place.texcoord, i), float(level));
  } while (++level < LEVELS);
  return texel;
}

Layer fetchLayer(Place place, int index) {
  return Layer(index);
}
