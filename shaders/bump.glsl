// The model `bump`: BumpModel.h has the formula. Shared: albedo, then a texel of parabolic normal and roughness.
#include "ggx.glsl"

float evaluateModel(SharedNumbers shared_, LayerNumbers layer, vec3 light, vec3 view) {
  vec3 numbers = shared_.texels[1].xyz;
  float squared = dot(numbers.xy, numbers.xy);
  vec3 n = vec3(2.0 * numbers.xy, 1.0 - squared) / (1.0 + squared);
  float nl = dot(n, light);
  if (nl <= 0.0) return 0.0;
  vec3 h = light + view;
  h *= inversesqrt(max(dot(h, h), 1e-12));
  float nv = max(abs(dot(n, view)), 1e-4);
  float reflected = mix(0.04, 1.0, pow(1.0 - clamp(dot(view, h), 0.0, 1.0), 5.0));
  float specular = 3.14159265358979 * microfacets(numbers.z * numbers.z, n, h, nl, nv);
  return nl * mix(shared_.texels[0].a, specular, reflected);
}
