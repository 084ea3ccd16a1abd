// Light from an environment: what PrefilteredEnvironment and MicrofacetTable hold
// (materials/src/materials/LightFromEnvironment.cpp puts them on their units). Everything is in
// units of a white surface, which shows 1 in an environment of 1, and without environmentIntensity,
// by which the sum is multiplied.
#include "table.glsl"

#ifdef ENVIRONMENT

#include "bindings.glsl"

// octahedral; a layer a moment
layout(binding = environmentMomentsUnit) uniform sampler3D environmentMoments;
// octahedral; along z the roughness
layout(binding = environmentGlossyUnit) uniform sampler3D environmentGlossy;
layout(binding = microfacetTableUnit) uniform sampler2D microfacetTable;

// The surface's axes, tangent frame, in the environment: n lies along the third.
struct EnvironmentFrame {
  mat3 axes;
  vec3 diffuse;        // what a white diffuse surface shows
  vec3 moments[6];  // of light times xx, yy, xy, x, y, 1 (rfp.glsl)
};

vec3 toEnvironment(vec3 world) {
  return vec3(dot(environmentRows[0].xyz, world), dot(environmentRows[1].xyz, world),
              dot(environmentRows[2].xyz, world));
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

#include "lobes.glsl"

// What a white diffuse surface of this normal shows; directions in the environment.
vec3 diffuseAround(vec3 normal) {
  return averageOfLobe(normal, 0.0);
}

// What microfacets of a roughness mirror around a direction of the environment.
vec3 glossyAround(vec3 d, float roughness) {
  return layerOf(environmentGlossy, d, roughness * float(textureSize(environmentGlossy, 0).z - 1));
}

// How much microfacets reflect in all: x times F0, and y.
vec2 microfacetShares(float nv, float roughness) {
  return valueOfTable(microfacetTable, vec2(nv, roughness)).xy;
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
  frame.moments[2] = t.x * b.x * m[4] + t.y * b.y * m[5] + t.z * b.z * m[6] +
                     (t.x * b.y + t.y * b.x) * m[7] + (t.x * b.z + t.z * b.x) * m[8] +
                     (t.y * b.z + t.z * b.y) * m[9];
  frame.moments[3] = t.x * m[1] + t.y * m[2] + t.z * m[3];
  frame.moments[4] = b.x * m[1] + b.y * m[2] + b.z * m[3];
  frame.moments[5] = m[0];
}

#else
struct EnvironmentFrame {
  int none;
};
#endif
