// The models `laf` and `slaf`: LafModel.h has the formula. Shared: the diffuse albedo, then a texel a lobe: amplitude, packed axes,
// exponent; of a layer the view factor.

float evaluateModel(SharedNumbers shared_, LayerNumbers layer, vec3 light, vec3 view) {
  vec3 products = light * view;
  float value = shared_.texels[0].a;
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = shared_.texels[1 + j];
    float s = max(1.0, max(abs(lobe.y), abs(lobe.z)));
    float base = dot(vec3(lobe.yz / s, 2.0 - s), products);
    if (base > 0.0) value += lobe.x * pow(base, lobe.w);
  }
#if VIEW_FACTOR
  value *= layer.texels[0].x;
#endif
  return max(value, 0.0);
}
