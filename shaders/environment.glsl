// Light from an environment: what PrefilteredEnvironment and MicrofacetTable hold (materials/src/materials/ImageBasedLight.cpp
// puts them on their units). Everything is in units of a white surface, which shows 1 in an environment of 1, and without
// environmentIntensity, by which the sum is multiplied.
#ifdef ENVIRONMENT

#ifdef ENVIRONMENT_PARABOLIC
layout(binding = 16) uniform sampler2DRect environmentLobes;  // a column of maps: half around +z, half around -z; exponents 2^(i / 2)
#else
layout(binding = 16) uniform sampler3D environmentLobes;  // octahedral; along z log2 of the exponent, ENVIRONMENT_LOBES an octave
#endif
layout(binding = 17) uniform sampler3D environmentMoments;  // octahedral; a layer a moment
layout(binding = 18) uniform sampler3D environmentGlossy;   // octahedral; along z the roughness
layout(binding = 19) uniform sampler2D microfacetTable;

// The surface's axes, tangent frame, in the environment: n lies along the third.
struct EnvironmentFrame {
  mat3 axes;
  vec3 matt;        // what a white matt surface shows
  vec3 moments[6];  // of light times xx, yy, xy, x, y, 1 (rfp.glsl)
};

vec3 toEnvironment(vec3 world) {
  return vec3(dot(environmentRows[0].xyz, world), dot(environmentRows[1].xyz, world), dot(environmentRows[2].xyz, world));
}

// OctahedralMap.h: the place of a direction of any length in a bordered map of so many texels.
vec2 octahedralPlace(vec3 d, float imageSize) {
  vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
  if (d.z < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
  return 0.5 + 0.5 * p * (1.0 - 2.0 / imageSize);
}

vec3 layerOf(sampler3D maps, vec3 d, float layer) {
  vec3 size = vec3(textureSize(maps, 0));
  return textureLod(maps, vec3(octahedralPlace(d, size.x), (layer + 0.5) / size.z), 0.0).rgb;
}

// Bilinear between values of which the first and last lie at 0 and 1.
vec3 valueOfTable(sampler2D table, vec2 place) {
  vec2 size = vec2(textureSize(table, 0));
  return textureLod(table, (place * (size - 1.0) + 0.5) / size, 0.0).rgb;
}

#ifdef ENVIRONMENT_PARABOLIC
// Paper M 5.2: the exponent is rounded to 2^(i / 2), i = 0..10, of which the power comes back in `exponent`.
vec3 averageOfLobe(vec3 d, inout float exponent) {
  float i = clamp(round(2.0 * log2(exponent)), 0.0, 10.0);
  exponent = exp2(0.5 * i);
  d = normalize(d);
  float side = float(textureSize(environmentLobes).x);
  vec2 p = 0.5 + 0.5 * d.xy / (1.0 + abs(d.z)) * (1.0 - 2.0 / side);
  float map = 2.0 * i + (d.z < 0.0 ? 1.0 : 0.0);
  return texture(environmentLobes, side * (p + vec2(0.0, map))).rgb;
}
#else
vec3 averageOfLobe(vec3 d, float logExponent) {
  return layerOf(environmentLobes, d, float(ENVIRONMENT_LOBES) * max(logExponent, 0.0));
}
#endif

// What a white matt surface of this normal shows; directions in the environment.
vec3 mattAround(vec3 normal) {
#ifdef ENVIRONMENT_PARABOLIC
  float exponent = 1.0;
  return averageOfLobe(normal, exponent);
#else
  return averageOfLobe(normal, 0.0);
#endif
}

// What microfacets of a roughness mirror around a direction of the environment.
vec3 glossyAround(vec3 d, float roughness) {
  return layerOf(environmentGlossy, d, roughness * float(textureSize(environmentGlossy, 0).z - 1));
}

// How much microfacets reflect in all: x times F0, and y.
vec2 microfacetShares(float nv, float roughness) {
  return valueOfTable(microfacetTable, vec2(nv, roughness)).xy;
}

// The integral of light times (t.l)^exponent n.l, divided by pi; t in the tangent frame.
vec3 lightOfLobe(EnvironmentFrame frame, vec3 t, float exponent) {
#ifdef ENVIRONMENT_PARABOLIC
  vec3 average = averageOfLobe(frame.axes * t, exponent);
  return 2.0 / (exponent + 1.0) * max(t.z, 0.0) * average;
#else
  // CosineLobe.cpp: lobeAboveHorizon().
  float narrow = 1.0 / (exponent + 2.0);
  float mean = t.z * (1.0 - narrow);
  float spread = 0.6366 * max(1.0 - t.z * t.z, 0.0) * narrow * (1.0 - 0.42 * narrow);
  float squared = mean * mean + spread;
  float inverse = inversesqrt(squared);
  float root = squared * inverse;
  float cut = spread * inverse * inverse;
  float facing = max(0.5 * (mean + root) - 0.25 * root * cut * (1.0 - cut) * (1.0 - 0.5 * cut), 0.0);
  float shift = narrow * inverse * (1.0 + 0.85 * narrow * cut * cut) * (mean < 0.0 ? 1.0 + 1.85 * (1.0 - cut) : 1.0);
  float below = 0.5 - 0.5 * mean * inverse;
  vec3 direction = frame.axes * (t + shift * (vec3(0.0, 0.0, 1.0) - t.z * t));
  return 2.0 / (exponent + 1.0) * facing *
         averageOfLobe(direction, log2(exponent + 1.0) + below * (1.05 + 1.37 * narrow));
#endif
}

// The moments around the normal, in the tangent frame.
void fetchMoments(inout EnvironmentFrame frame) {
  vec3 m[10];
  for (int i = 0; i < 10; ++i) m[i] = layerOf(environmentMoments, frame.axes[2], float(i));
  vec3 t = frame.axes[0], b = frame.axes[1];
  frame.moments[0] = t.x * t.x * m[4] + t.y * t.y * m[5] + t.z * t.z * m[6] +
                     2.0 * (t.x * t.y * m[7] + t.x * t.z * m[8] + t.y * t.z * m[9]);
  frame.moments[1] = b.x * b.x * m[4] + b.y * b.y * m[5] + b.z * b.z * m[6] +
                     2.0 * (b.x * b.y * m[7] + b.x * b.z * m[8] + b.y * b.z * m[9]);
  frame.moments[2] = t.x * b.x * m[4] + t.y * b.y * m[5] + t.z * b.z * m[6] + (t.x * b.y + t.y * b.x) * m[7] +
                     (t.x * b.z + t.z * b.x) * m[8] + (t.y * b.z + t.z * b.y) * m[9];
  frame.moments[3] = t.x * m[1] + t.y * m[2] + t.z * m[3];
  frame.moments[4] = b.x * m[1] + b.y * m[2] + b.z * m[3];
  frame.moments[5] = m[0];
}

#endif
