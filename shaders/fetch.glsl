// The numbers of a reflectance field, fetched from where FieldTextures.h packs them.
//
// A colour channel has SHARED_TEXELS texels for all layers and LAYER_TEXELS a layer. The first
// shared texel is the base colour and, as alpha, the first shared number. A model's GLSL file
// defines evaluateModel(), what the base colour is multiplied by.
#include "bindings.glsl"

layout(binding = layerParametersUnit) uniform sampler2DArray layerParameters;
layout(binding = sharedParametersUnit) uniform sampler2DArray sharedParameters;

layout(std140, binding = materialBinding) uniform ReflectanceField {
  vec2 textureScale;         // repetitions per unit of texture coordinates
  float lowestLightZ;        // of the measured lights; where a field that contains n.l ends
  float lowestViewZ;         // of the measured views; models see no lower ones
  vec3 tint;                 // what the result is multiplied by
  float quadratureExponent;  // of lobes as wide as the measured lights are apart
};

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

Texel fetchTexel(ivec2 place) {
  Texel texel;
  for (int c = 0; c < COLOR_CHANNELS; ++c)
    for (int i = 0; i < SHARED_TEXELS; ++i)
      texel.channels[c].texels[i] =
          texelFetch(sharedParameters, ivec3(place, c * SHARED_TEXELS + i), 0);
  return texel;
}

Layer fetchLayerFrom(sampler2DArray image, ivec2 place, int index) {
  Layer layer;
  for (int c = 0; c < COLOR_CHANNELS; ++c)
    for (int i = 0; i < LAYER_TEXELS; ++i)
      layer.channels[c].texels[i] =
          texelFetch(image, ivec3(place, (index * COLOR_CHANNELS + c) * LAYER_TEXELS + i), 0);
  return layer;
}

Layer fetchLayer(ivec2 place, int index) {
  return fetchLayerFrom(layerParameters, place, index);
}

// The direction that varies within a layer: each *shade* stage defines it.
vec3 variedDirection(vec3 light, vec3 view);

// What a fit of stored values is read through, where DECODE names one of these (core/Color.h).
vec3 decodeGamma22(vec3 stored) { return pow(max(stored, 0.0), vec3(2.2)); }

vec3 decodeSrgb(vec3 stored) {
  stored = max(stored, 0.0);
  return mix(pow((stored + 0.055) / 1.055, vec3(2.4)), stored / 12.92,
             lessThanEqual(stored, vec3(0.04045)));
}
