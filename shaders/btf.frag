// A reflectance field under point and directional lights (paper M eq. 4) and an environment (5.2).
#version 450 core
#include "lights.glsl"
#include "environment.glsl"
#include "tangent_frame.glsl"
#include "layer_lookup.glsl"
#include "field_numbers.glsl"
#include "model.glsl"
#include "shown.glsl"

layout(std140, binding = 2) uniform ReflectanceField {
  vec2 textureScale;   // repetitions per unit of texture coordinates
  float lowestLightZ;  // of the measured lights; where a field that contains n.l ends
  float lowestViewZ;   // of the measured views; models see no lower ones
  float quadratureExponent;  // of lobes as wide as the measured lights are apart
};
#if defined(ENVIRONMENT) && defined(ENVIRONMENT_BY_QUADRATURE)
layout(binding = 4) uniform sampler2DRect quadrature;  // xyz: a measured light; w: its share of the integral
#endif

in vec3 position;
in vec3 normal;
in vec3 tangent;
in vec2 texcoord;
flat in float handedness;

layout(location = 0) out vec4 color;

struct Texel {
  SharedNumbers channels[COLOR_CHANNELS];
};

struct Layer {
  LayerNumbers channels[COLOR_CHANNELS];
};

Texel fetchTexel(ivec2 place) {
  Texel texel;
  for (int c = 0; c < COLOR_CHANNELS; ++c) texel.channels[c] = fetchShared(place, c);
  return texel;
}

Layer fetchLayer(ivec2 place, int index) {
  Layer layer;
  for (int c = 0; c < COLOR_CHANNELS; ++c) layer.channels[c] = fetchLayer(place, index, c);
  return layer;
}

// The direction, or the one at its azimuth on the ring at height z where it lies below that.
vec3 notBelow(vec3 direction, float z) {
  if (direction.z >= z) return direction;
  // 0 where rounding lets the pole lie below a ring at the pole.
  vec2 azimuth = direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-30));
  return vec3(azimuth * sqrt(1.0 - z * z), z);
}

// Linear RGB, with or without n.l as it was fitted.
vec3 modelValue(Texel texel, Layer layer, vec3 light, vec3 view) {
  vec3 value;
  for (int c = 0; c < COLOR_CHANNELS; ++c) value[c] = evaluateModel(texel.channels[c], layer.channels[c], light, view);
  if (COLOR_CHANNELS == 1) value = value.xxx;
  return DECODE(value * texel.channels[0].texels[0].rgb);
}

// The value, n.l included, for light from `light` above the horizon (FieldFormula.h: evaluate).
vec3 valueWithCosine(Texel texel, Layer layer, vec3 light, vec3 view) {
#ifdef MODEL_HAS_COSINE
  if (light.z < lowestLightZ)
    return light.z / lowestLightZ * modelValue(texel, layer, notBelow(light, lowestLightZ), view);
  return modelValue(texel, layer, light, view);
#else
  return light.z * modelValue(texel, layer, light, view);
#endif
}

#ifdef ENVIRONMENT
EnvironmentFrame environmentFrame(TangentFrame frame) {
  EnvironmentFrame turned;
  turned.axes = mat3(toEnvironment(frame.t), toEnvironment(frame.b), toEnvironment(frame.n));
#ifndef ENVIRONMENT_BY_QUADRATURE
  prepareEnvironment(turned);
#endif
  return turned;
}

#ifdef ENVIRONMENT_BY_QUADRATURE
int quadratureLights() {
  return textureSize(quadrature).x;
}

// Irradiance, divided by pi n.l, around a measured light.
vec3 quadratureLight(int index, EnvironmentFrame frame, out vec3 light) {
  vec4 node = texelFetch(quadrature, ivec2(index, 0));
  light = node.xyz;
#ifdef ENVIRONMENT_PARABOLIC
  float exponent = quadratureExponent;
  vec3 average = averageOfLobe(frame.axes * light, exponent);
#else
  vec3 average = averageOfLobe(frame.axes * light, log2(quadratureExponent));
#endif
  return node.w / light.z * average;
}
#else
// What one layer shows; each colour channel of a fit in RGB has lobes of its own.
vec3 environmentValue(Texel texel, Layer layer, ivec2 place, int index, vec3 view, EnvironmentFrame frame) {
#ifdef ENVIRONMENT_LAYERS
  for (int c = 0; c < COLOR_CHANNELS; ++c) layer.channels[c] = fetchLayerOf(environmentNumbers, place, index, c);
#endif
  vec3 value = underEnvironment(texel.channels[0], layer.channels[0], view, frame);
  for (int c = 1; c < COLOR_CHANNELS; ++c)
    value[c] = underEnvironment(texel.channels[c], layer.channels[c], view, frame)[c];
  return value * texel.channels[0].texels[0].rgb;
}
#endif
#else
struct EnvironmentFrame {
  int none;
};
EnvironmentFrame environmentFrame(TangentFrame frame) {
  return EnvironmentFrame(0);
}
#endif

// The radiance towards the eye that one texel would give here.
vec3 radianceOf(ivec2 place, vec3 view, TangentFrame frame, EnvironmentFrame turned) {
  Texel texel = fetchTexel(place);
  vec3 seenFrom = notBelow(view, lowestViewZ);
  vec3 radiance = vec3(0.0), fromEnvironment = vec3(0.0);
#ifdef LAYERS_ARE_LIGHTS
  for (int i = 0; i < lightCount; ++i) {
    vec3 toLight;
    vec3 irradiance = lightAt(i, position, toLight);
    vec3 l = toFrame(frame, toLight);
    if (l.z <= 0.0) continue;
    LayerWeights layers = findLayers(l);
    for (int k = 0; k < 3; ++k)
      if (layers.weight[k] > 0.0)
        radiance += layers.weight[k] * irradiance * valueWithCosine(texel, fetchLayer(place, layers.index[k]), l, seenFrom);
  }
#ifdef ENVIRONMENT
  for (int i = 0; i < quadratureLights(); ++i) {
    vec3 l;
    vec3 light = quadratureLight(i, turned, l);
    LayerWeights layers = findLayers(l);
    for (int k = 0; k < 3; ++k)
      if (layers.weight[k] > 1e-4)
        fromEnvironment += layers.weight[k] * light * valueWithCosine(texel, fetchLayer(place, layers.index[k]), l, seenFrom);
  }
#endif
#else
  LayerWeights layers = findLayers(view);
  for (int k = 0; k < 3; ++k) {
    if (layers.weight[k] == 0.0) continue;
    Layer layer = fetchLayer(place, layers.index[k]);
    for (int i = 0; i < lightCount; ++i) {
      vec3 toLight;
      vec3 irradiance = lightAt(i, position, toLight);
      vec3 l = toFrame(frame, toLight);
      if (l.z > 0.0) radiance += layers.weight[k] * irradiance * valueWithCosine(texel, layer, l, seenFrom);
    }
#ifdef ENVIRONMENT
#ifdef ENVIRONMENT_BY_QUADRATURE
    for (int i = 0; i < quadratureLights(); ++i) {
      vec3 l;
      vec3 light = quadratureLight(i, turned, l);
      fromEnvironment += layers.weight[k] * light * valueWithCosine(texel, layer, l, seenFrom);
    }
#else
    fromEnvironment += layers.weight[k] * environmentValue(texel, layer, place, layers.index[k], seenFrom, turned);
#endif
#endif
  }
#endif
#ifdef ENVIRONMENT
  fromEnvironment *= environmentIntensity.w * environmentIntensity.rgb;
#endif
  return radiance / 3.14159265358979 + fromEnvironment;
}

void main() {
  TangentFrame frame = tangentFrame(normal, tangent, handedness, !gl_FrontFacing);
  EnvironmentFrame turned = environmentFrame(frame);
  vec3 view = toFrame(frame, toEye(position));
  ivec2 size = textureSize(sharedNumbers, 0).xy;
  vec2 place = fract(texcoord * textureScale) * vec2(size);
#ifdef BILINEAR
  // Lobes cannot be mixed, what they give can.
  vec2 low = floor(place - 0.5);
  vec2 share = place - 0.5 - low;
  vec3 radiance = vec3(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    ivec2 offset = ivec2(corner & 1, corner >> 1);
    vec2 weight = mix(1.0 - share, share, vec2(offset));
    radiance += weight.x * weight.y * radianceOf((ivec2(low) + offset + size) % size, view, frame, turned);
  }
#else
  // fract() of a tiny negative number rounds to 1.
  vec3 radiance = radianceOf(min(ivec2(place), size - 1), view, frame, turned);
#endif
  color = shown(vec4(radiance, 1.0));
}
