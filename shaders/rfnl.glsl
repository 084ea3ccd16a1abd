// The models `rfnl` and `lfnl`: RfnlModel.h has the formula. A texel a lobe: amplitude, parabolic
// direction, exponent; with a diffuse albedo of each view's own, one more.

float evaluateModel(SharedParameters shared_, LayerParameters layer, vec3 light, vec3 view) {
  vec3 varied = variedDirection(light, view);
#if OWN_DIFFUSE_ALBEDO
  float value = diffusePart * layer.texels[LOBES].x;
#else
  float value = diffusePart * shared_.texels[0].a;
#endif
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = layer.texels[j];
    float squared = dot(lobe.yz, lobe.yz);
    vec3 direction = vec3(2.0 * lobe.yz, 1.0 - squared) / (1.0 + squared);
    float cosine = dot(direction, varied);
    if (cosine > 0.0) value += specularPart * lobe.x * pow(cosine, lobe.w);
  }
  return max(value, 0.0);
}

#ifdef ENVIRONMENT
void prepareEnvironment(inout EnvironmentFrame frame) {
  frame.diffuse = diffuseAround(frame.axes[2]);
}

// [Meseth 2004] 5.2.
vec3 underEnvironment(SharedParameters shared_, LayerParameters layer, vec3 view,
                      EnvironmentFrame frame) {
#if OWN_DIFFUSE_ALBEDO
  vec3 value = diffusePart * layer.texels[LOBES].x * frame.diffuse;
#else
  vec3 value = diffusePart * shared_.texels[0].a * frame.diffuse;
#endif
#ifndef ONLY_DIFFUSE
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = layer.texels[j];
    if (lobe.x == 0.0) continue;
    float squared = dot(lobe.yz, lobe.yz);
    vec3 direction = vec3(2.0 * lobe.yz, 1.0 - squared) / (1.0 + squared);
#ifdef ENVIRONMENT_LAYERS
    value += lobe.x * averageOfLobe(frame.axes * direction, lobe.w);
#else
    value += lobe.x * lightOfLobe(frame, direction, lobe.w);
#endif
  }
#endif
  return max(value, 0.0);
}
#endif
