// The lobe that GlossLobe.h describes, from its four numbers.
#include "ggx.glsl"

struct GlossLobe {
  vec3 normal;
  float alpha;
  float amount;
};

GlossLobe glossLobe(vec4 numbers) {
  vec2 tilt = 0.5 * numbers.xy;
  float squared = dot(tilt, tilt);
  return GlossLobe(vec3(2.0 * tilt, 1.0 - squared) / (1.0 + squared),
                   max(numbers.z * numbers.z, 0.1), numbers.w * numbers.w);
}

// Without n.l.
float glossValue(GlossLobe lobe, vec3 light, vec3 view) {
  vec3 h = light + view;
  h *= inversesqrt(max(dot(h, h), 1e-12));
  return 3.14159265358979 * lobe.amount *
         microfacets(lobe.alpha, lobe.normal, h, light.z, max(view.z, 1e-4));
}

#ifdef ENVIRONMENT
// The split sum, as of bump.glsl, but for Fresnel's factor.
vec3 glossUnderEnvironment(GlossLobe lobe, vec3 view, EnvironmentFrame frame) {
  float roughness = sqrt(lobe.alpha);
  vec2 shares = microfacetShares(clamp(abs(dot(lobe.normal, view)), 0.0, 1.0), roughness);
  return lobe.amount * (shares.x + shares.y) *
         glossyAround(frame.axes * reflect(-view, lobe.normal), roughness);
}
#endif
