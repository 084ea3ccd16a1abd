// KHR_materials_clearcoat: a clear coat over everything else, with a normal and a roughness of its
// own. Its Fresnel is that at n.v, so that what it takes is the same for all lights.
#ifdef CLEARCOAT

layout(binding = clearcoatUnit) uniform sampler2D clearcoatTexture;
layout(binding = clearcoatRoughnessUnit) uniform sampler2D clearcoatRoughnessTexture;
layout(binding = clearcoatNormalUnit) uniform sampler2D clearcoatNormalTexture;

struct Coat {
  vec3 n;
  float roughness;
  float share;  // of the light that it mirrors
};

Coat coatOf(TangentFrame frame, vec3 v) {
  float factor = clearcoatFactors.x, roughness = clearcoatFactors.y;
#ifdef CLEARCOAT_TEXTURE
  factor *= fetch(clearcoatTexture, clearcoatUnit).r;
#endif
#ifdef CLEARCOAT_ROUGHNESS_TEXTURE
  roughness *= fetch(clearcoatRoughnessTexture, clearcoatRoughnessUnit).g;
#endif
  vec3 n = frame.n;
#ifdef CLEARCOAT_NORMAL_TEXTURE
  n = mappedNormal(frame, fetch(clearcoatNormalTexture, clearcoatNormalUnit).xyz, clearcoatFrame,
                   clearcoatFactors.z);
#endif
  float fresnel = mix(0.04, 1.0, pow(1.0 - min(abs(dot(n, v)), 1.0), 5.0));
  return Coat(gl_FrontFacing ? n : -n, max(roughness, smoothest), factor * fresnel);
}

// What shows below it, and itself, of a light.
vec3 belowCoat(Coat coat, vec3 shown, vec3 v, vec3 l) {
  float nl = dot(coat.n, l);
  float mirrored = 0.0;
  if (nl > 0.0) {
    float alpha = coat.roughness * coat.roughness;
    mirrored = nl * microfacets(alpha, coat.n, halfway(v, l), nl, max(abs(dot(coat.n, v)), 1e-4));
  }
  return mix(shown, vec3(specularPart * mirrored), coat.share);
}

#ifdef ENVIRONMENT
vec3 belowCoatInEnvironment(Coat coat, vec3 shown, vec3 v) {
  float nv = dot(coat.n, v);
  vec2 shares = microfacetShares(clamp(abs(nv), 0.0, 1.0), coat.roughness);
  vec3 around = glossyAround(toEnvironment(2.0 * nv * coat.n - v), coat.roughness);
  return mix(shown, specularPart * (shares.x + shares.y) * around, coat.share);
}
#endif
#endif
