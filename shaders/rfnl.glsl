// The models `rfnl` and `lfnl`: RfnlModel.h has the formula. A texel a lobe: amplitude, parabolic direction, exponent; with a
// diffuse albedo of each view's own, one more.

float evaluateModel(SharedNumbers shared_, LayerNumbers layer, vec3 light, vec3 view) {
  vec3 varied = variedDirection(light, view);
#if OWN_DIFFUSE_ALBEDO
  float value = layer.texels[LOBES].x;
#else
  float value = shared_.texels[0].a;
#endif
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = layer.texels[j];
    float squared = dot(lobe.yz, lobe.yz);
    vec3 direction = vec3(2.0 * lobe.yz, 1.0 - squared) / (1.0 + squared);
    float cosine = dot(direction, varied);
    if (cosine > 0.0) value += lobe.x * pow(cosine, lobe.w);
  }
  return max(value, 0.0);
}
