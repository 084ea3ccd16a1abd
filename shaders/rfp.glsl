// The models `rfp`, `lfp` and `ptm`: RfpModel.h has the formula. Two texels a layer: a0..a3, a4 a5.

float evaluateModel(SharedParameters shared_, LayerParameters layer, vec3 light, vec3 view) {
  vec3 d = variedDirection(light, view);
  vec4 a = layer.texels[0];
  vec2 b = layer.texels[1].xy;
  // What a polynomial reflects is not told apart: it counts as diffuse.
  float value = dot(a, vec4(d.x * d.x, d.y * d.y, d.x * d.y, d.x)) + b.x * d.y + b.y;
  return diffusePart * max(value, 0.0);
}

#ifdef ENVIRONMENT
void prepareEnvironment(inout EnvironmentFrame frame) {
  fetchMoments(frame);
}

// Exact, but that it is the integral that is clamped at 0 and not the polynomial.
vec3 underEnvironment(SharedParameters shared_, LayerParameters layer, vec3 view,
                      EnvironmentFrame frame) {
  vec4 a = layer.texels[0];
  vec2 b = layer.texels[1].xy;
  vec3 value = a.x * frame.moments[0] + a.y * frame.moments[1] + a.z * frame.moments[2] +
               a.w * frame.moments[3] + b.x * frame.moments[4] + b.y * frame.moments[5];
  return diffusePart * max(value, 0.0);
}
#endif
