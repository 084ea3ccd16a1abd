// The numbers of a reflectance field, fetched from where FieldTextures.h packs them.
//
// A colour channel has SHARED_TEXELS texels for all layers and LAYER_TEXELS a layer. The first
// shared texel is the base colour and, as alpha, the first shared number. A model's GLSL file
// defines evaluateModel(), what the base colour is multiplied by. The place of a texel is a struct
// of the *where* stage.
#include "field_block.glsl"

layout(binding = layerParametersUnit) uniform sampler2DArray layerParameters;
layout(binding = sharedParametersUnit) uniform sampler2DArray sharedParameters;

struct SharedParameters {
  vec4 texels[SHARED_TEXELS];
};

struct LayerParameters {
  vec4 texels[max(LAYER_TEXELS, 1)];
};

struct Texel {
  SharedParameters channels[COLOR_CHANNELS];
};

struct Layer {
  LayerParameters channels[COLOR_CHANNELS];
};

// In texels.
ivec2 fieldSize() {
  return textureSize(sharedParameters, 0).xy;
}

int fieldLevels() {
  return textureQueryLevels(sharedParameters);
}

// Texels of these models stay where they are.
Place seenAt(Place place, LayerWeights layers, vec3 view) {
  return place;
}

Texel fetchTexel(Place place) {
  Texel texel;
  for (int c = 0; c < COLOR_CHANNELS; ++c)
    for (int i = 0; i < SHARED_TEXELS; ++i)
      texel.channels[c].texels[i] =
          texelFetch(sharedParameters, ivec3(place.texel, c * SHARED_TEXELS + i), place.level);
  return texel;
}

Layer fetchLayerFrom(sampler2DArray image, Place place, int index) {
  Layer layer;
  for (int c = 0; c < COLOR_CHANNELS; ++c)
    for (int i = 0; i < LAYER_TEXELS; ++i)
      layer.channels[c].texels[i] =
          texelFetch(image, ivec3(place.texel, (index * COLOR_CHANNELS + c) * LAYER_TEXELS + i),
                     place.level);
  return layer;
}

Layer fetchLayer(Place place, int index) {
  return fetchLayerFrom(layerParameters, place, index);
}
