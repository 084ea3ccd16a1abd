// The models `rfp`, `lfp` and `ptm`: RfpModel.h has the formula. Two texels a layer: a0..a3, a4 a5.

float evaluateModel(SharedNumbers shared_, LayerNumbers layer, vec3 light, vec3 view) {
  vec3 d = variedDirection(light, view);
  vec4 a = layer.texels[0];
  vec2 b = layer.texels[1].xy;
  return max(dot(a, vec4(d.x * d.x, d.y * d.y, d.x * d.y, d.x)) + b.x * d.y + b.y, 0.0);
}
