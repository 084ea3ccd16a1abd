// KHR_materials_sheen: the sheen of Conty and Kulla 2017 (SheenTable.h), which takes from what is
// below what it reflects itself.
#ifdef SHEEN

#include "table.glsl"

layout(binding = sheenColorUnit) uniform sampler2D sheenColorTexture;
layout(binding = sheenRoughnessUnit) uniform sampler2D sheenRoughnessTexture;
layout(binding = sheenTableUnit) uniform sampler2D sheenTable;

struct SheenLayer {
  vec3 color;
  float roughness;
  float share;  // of light from everywhere that white sheen reflects towards the eye
};

float sheenShare(float cosine, float roughness) {
  return valueOfTable(sheenTable, vec2(clamp(abs(cosine), 0.0, 1.0), roughness)).r;
}

SheenLayer sheenOf(vec3 n, vec3 v) {
  vec3 sheenColor = sheenFactors.rgb;
  float roughness = sheenFactors.w;
#ifdef SHEEN_COLOR_TEXTURE
  sheenColor *= fetch(sheenColorTexture, sheenColorUnit).rgb;
#endif
#ifdef SHEEN_ROUGHNESS_TEXTURE
  roughness *= fetch(sheenRoughnessTexture, sheenRoughnessUnit).a;
#endif
  roughness = max(roughness, 0.07);
  return SheenLayer(sheenColor, roughness, sheenShare(dot(n, v), roughness));
}

// How much of what is below is left, where white sheen takes so much.
float leftBelowSheen(SheenLayer sheen, float share) {
  return 1.0 - max(sheen.color.r, max(sheen.color.g, sheen.color.b)) * share;
}

float sheenCurve(float x, float smoothShare) {
  float a = mix(21.5473, 25.3245, smoothShare), b = mix(3.82987, 3.32435, smoothShare);
  float c = mix(0.19823, 0.16801, smoothShare), d = mix(-1.97760, -1.27393, smoothShare);
  return a / (1.0 + b * pow(x, c)) + d * x + mix(-4.32054, -4.85967, smoothShare);
}

float sheenShadowing(float cosine, float r) {
  float smoothShare = (1.0 - r) * (1.0 - r);
  return exp(cosine < 0.5 ? sheenCurve(cosine, smoothShare)
                          : 2.0 * sheenCurve(0.5, smoothShare) -
                                sheenCurve(1.0 - cosine, smoothShare));
}

// What shows of a light below it, and of itself.
vec3 belowSheen(SheenLayer sheen, vec3 shown, vec3 n, vec3 v, vec3 l) {
  float nl = dot(n, l);
  if (nl <= 0.0) return vec3(0.0);
  float nv = clamp(abs(dot(n, v)), 1e-4, 1.0), r = sheen.roughness * sheen.roughness;
  float nh = dot(n, halfway(v, l));
  float fibres = (2.0 + 1.0 / r) * pow(max(1.0 - nh * nh, 0.0), 0.5 / r) / (2.0 * pi);
  float shadowing = 1.0 + sheenShadowing(nv, r) + sheenShadowing(min(nl, 1.0), r);
  float left = leftBelowSheen(sheen, max(sheen.share, sheenShare(nl, sheen.roughness)));
  return left * shown + specularPart * fibres / (4.0 * nv * shadowing) * sheen.color;
}
#endif
