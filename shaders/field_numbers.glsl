// The numbers of a reflectance field, and how they are packed into RGBA texels (BTFMaterial.cpp: packed()).
//
// A colour channel has SHARED_TEXELS texels for all layers and LAYER_TEXELS a layer. The first shared texel is the base colour and,
// as alpha, the first shared number. A model's GLSL file defines evaluateModel(), what the base colour is multiplied by.

layout(binding = 0) uniform sampler2DArray layerNumbers;
layout(binding = 1) uniform sampler2DArray sharedNumbers;

struct SharedNumbers {
  vec4 texels[SHARED_TEXELS];
};

struct LayerNumbers {
  vec4 texels[max(LAYER_TEXELS, 1)];
};

SharedNumbers fetchShared(ivec2 texel, int channel) {
  SharedNumbers numbers;
  for (int i = 0; i < SHARED_TEXELS; ++i)
    numbers.texels[i] = texelFetch(sharedNumbers, ivec3(texel, channel * SHARED_TEXELS + i), 0);
  return numbers;
}

LayerNumbers fetchLayerOf(sampler2DArray image, ivec2 texel, int layer, int channel) {
  LayerNumbers numbers;
  int first = (layer * COLOR_CHANNELS + channel) * LAYER_TEXELS;
  for (int i = 0; i < LAYER_TEXELS; ++i) numbers.texels[i] = texelFetch(image, ivec3(texel, first + i), 0);
  return numbers;
}

LayerNumbers fetchLayer(ivec2 texel, int layer, int channel) {
  return fetchLayerOf(layerNumbers, texel, layer, channel);
}

// The paper's way with lobes takes them as they are.
#ifdef ENVIRONMENT_PARABOLIC
#undef ENVIRONMENT_LAYERS
#endif
#ifdef ENVIRONMENT_LAYERS
layout(binding = 5) uniform sampler2DArray environmentNumbers;  // ReflectanceModel::prepareForEnvironments()
#endif

// The direction that varies within a layer.
vec3 variedDirection(vec3 light, vec3 view) {
#ifdef LAYERS_ARE_LIGHTS
  return view;
#else
  return light;
#endif
}

// What a fit of stored values is read through, where DECODE names one of these (core/Color.h).
vec3 decodeGamma22(vec3 stored) { return pow(max(stored, 0.0), vec3(2.2)); }

vec3 decodeSrgb(vec3 stored) {
  stored = max(stored, 0.0);
  return mix(pow((stored + 0.055) / 1.055, vec3(2.4)), stored / 12.92, lessThanEqual(stored, vec3(0.04045)));
}
