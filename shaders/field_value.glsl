// What one layer of a texel gives (FieldFormula.h).

// The direction, or the one at its azimuth on the ring at height z where it lies below that.
vec3 notBelow(vec3 direction, float z) {
  if (direction.z >= z) return direction;
  // 0 where rounding lets the pole lie below a ring at the pole.
  vec2 azimuth = direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-30));
  return vec3(azimuth * sqrt(1.0 - z * z), z);
}

// Linear RGB, with or without n.l as it was fitted.
vec3 modelValue(Texel texel, Layer layer, vec3 light, vec3 view) {
#ifdef MODEL_GIVES_COLOR
  return DECODE(evaluateColor(texel, layer, light, view));
#else
  vec3 value;
  for (int c = 0; c < COLOR_CHANNELS; ++c)
    value[c] = evaluateModel(texel.channels[c], layer.channels[c], light, view);
  if (COLOR_CHANNELS == 1) value = value.xxx;
  return DECODE(value * texel.channels[0].texels[0].rgb);
#endif
}

// The value, n.l included, for light from `light` above the horizon.
vec3 valueWithCosine(Texel texel, Layer layer, vec3 light, vec3 view) {
#ifdef MODEL_HAS_COSINE
  if (light.z < lowestLightZ)
    return light.z / lowestLightZ * modelValue(texel, layer, notBelow(light, lowestLightZ), view);
  return modelValue(texel, layer, light, view);
#else
  return light.z * modelValue(texel, layer, light, view);
#endif
}
