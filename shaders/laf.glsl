// The models `laf` and `slaf`: LafModel.h has the formula. Shared: the diffuse albedo, then a texel
// a lobe: amplitude, packed axes, exponent; of a layer the view factor.

float evaluateModel(SharedParameters shared_, LayerParameters layer, vec3 light, vec3 view) {
  vec3 products = light * view;
  float value = diffusePart * shared_.texels[0].a;
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = shared_.texels[1 + j];
    float s = max(1.0, max(abs(lobe.y), abs(lobe.z)));
    float base = dot(vec3(lobe.yz / s, 2.0 - s), products);
    if (base > 0.0) value += specularPart * lobe.x * pow(base, lobe.w);
  }
#if VIEW_FACTOR
  value *= layer.texels[0].x;
#endif
  return max(value, 0.0);
}

#ifdef ENVIRONMENT
void prepareEnvironment(inout EnvironmentFrame frame) {
  frame.diffuse = diffuseAround(frame.axes[2]);
}

// (C . (l v))^n = |t|^n (t . l / |t|)^n with t = C v: lobes of the light as those of `rfnl`.
vec3 underEnvironment(SharedParameters shared_, LayerParameters layer, vec3 view,
                      EnvironmentFrame frame) {
  vec3 value = diffusePart * shared_.texels[0].a * frame.diffuse;
#ifndef ONLY_DIFFUSE
  for (int j = 0; j < LOBES; ++j) {
    vec4 lobe = shared_.texels[1 + j];
    float s = max(1.0, max(abs(lobe.y), abs(lobe.z)));
    vec3 t = vec3(lobe.yz / s, 2.0 - s) * view;
    float size = length(t);
    if (size > 0.0) value += lobe.x * pow(size, lobe.w) * lightOfLobe(frame, t / size, lobe.w);
  }
#endif
#if VIEW_FACTOR
  value *= layer.texels[0].x;
#endif
  return max(value, 0.0);
}
#endif
