// The model `bump`: BumpModel.h has the formula. Shared: albedo, then a texel of parabolic normal
// and roughness.
#include "ggx.glsl"

float evaluateModel(SharedParameters shared_, LayerParameters layer, vec3 light, vec3 view) {
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
  return nl * mix(diffusePart * shared_.texels[0].a, specularPart * specular, reflected);
}

#ifdef ENVIRONMENT
void prepareEnvironment(inout EnvironmentFrame frame) {}

// As pbr.frag: the split sum, around the texel's own normal.
vec3 underEnvironment(SharedParameters shared_, LayerParameters layer, vec3 view,
                      EnvironmentFrame frame) {
  vec3 numbers = shared_.texels[1].xyz;
  float squared = dot(numbers.xy, numbers.xy);
  vec3 n = vec3(2.0 * numbers.xy, 1.0 - squared) / (1.0 + squared);
  vec2 shares = microfacetShares(clamp(abs(dot(n, view)), 0.0, 1.0), numbers.z);
  float reflected = 0.04 * shares.x + shares.y;
  vec3 mirrored = glossyAround(frame.axes * reflect(-view, n), numbers.z);
  return diffusePart * (1.0 - reflected) * shared_.texels[0].a * diffuseAround(frame.axes * n) +
         specularPart * reflected * mirrored;
}
#endif
