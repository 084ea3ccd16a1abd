// KHR_materials_anisotropy: GGX microfacets that are rougher along one direction of the surface.
#ifdef ANISOTROPY

layout(binding = anisotropyUnit) uniform sampler2D anisotropyTexture;

struct Grooves {
  TangentFrame frame;  // t: along which highlights are longer
  vec2 alpha;          // along t and b
};

Grooves groovesOf(TangentFrame frame, vec3 n, float alpha) {
  vec2 direction = vec2(1.0, 0.0);
  float strength = layerFactors.x;
#ifdef ANISOTROPY_TEXTURE
  vec3 texel = fetch(anisotropyTexture, anisotropyUnit).rgb;
  direction = 2.0 * texel.rg - 1.0;
  strength *= texel.b;
#endif
  direction = mat2(anisotropyFrame) * direction;
  vec3 along = direction.x * frame.t + direction.y * frame.b;
  return Grooves(tangentFrame(n, along, 1.0, false),
                 vec2(mix(alpha, 1.0, strength * strength), alpha));
}

// D V, as microfacets() of ggx.glsl has them for one alpha.
float microfacetsOfGrooves(Grooves grooves, vec3 v, vec3 l) {
  vec3 h = toFrame(grooves.frame, halfway(v, l));
  if (h.z <= 0.0) return 0.0;
  v = toFrame(grooves.frame, v);
  v.z = max(abs(v.z), 1e-4);
  l = toFrame(grooves.frame, l);
  vec3 scale = vec3(grooves.alpha, 1.0), leaning = h / scale;
  float width = dot(leaning, leaning);
  float shadowing = l.z * length(scale * v) + v.z * length(scale * l);
  return 0.5 / (pi * scale.x * scale.y * width * width * shadowing);
}

#ifdef ENVIRONMENT
// The average of what they mirror: that of microfacets as rough as the surface is across t, which
// lean along t besides. Their slopes there are spread as those of GGX.
vec3 mirroredByGrooves(Grooves grooves, vec3 v, float roughness) {
  const int count = 12;
  float squared = dot(grooves.alpha * grooves.alpha, vec2(1.0, -1.0));
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < count; ++i) {
    float place = (2.0 * float(i) + 1.0) / float(count) - 1.0;
    float slope = sqrt(max(squared, 0.0)) * place * inversesqrt(1.0 - place * place);
    vec3 h = normalize(grooves.frame.n + slope * grooves.frame.t);
    vec3 l = 2.0 * dot(v, h) * h - v;
    float weight = max(dot(grooves.frame.n, l), 1e-3);
    sum += weight * glossyAround(toEnvironment(l), roughness);
    weights += weight;
  }
  return sum / weights;
}
#endif
#endif
