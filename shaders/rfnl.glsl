// The model `rfnl`: RfnlModel.h has the formula. A texel a lobe: amplitude, parabolic direction, exponent; with a diffuse albedo
// of each view's own, one more.

const int texelsPerView = LOBES + OWN_DIFFUSE_ALBEDO;

struct ViewParameters {
  vec4 texels[texelsPerView];
};

ViewParameters fetchView(sampler2DArray parameters, ivec2 texel, int view) {
  ViewParameters p;
  for (int i = 0; i < texelsPerView; ++i) p.texels[i] = texelFetch(parameters, ivec3(texel, view * texelsPerView + i), 0);
  return p;
}

// Linear RGB for light from `l` (tangent frame), clamped at 0; with or without n.l, as it was fitted.
vec3 evaluateModel(vec4 shared_, ViewParameters p, vec3 l) {
#if OWN_DIFFUSE_ALBEDO
  float value = p.texels[LOBES].x;
#else
  float value = shared_.a;
#endif
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = p.texels[j];
    float squared = dot(lobe.yz, lobe.yz);
    vec3 direction = vec3(2.0 * lobe.yz, 1.0 - squared) / (1.0 + squared);
    float cosine = dot(direction, l);
    if (cosine > 0.0) value += lobe.x * pow(cosine, lobe.w);
  }
  return max(value, 0.0) * shared_.rgb;
}
