// Which layers of a field (measured views, or lights) a direction lies between, and their weights:
// HemisphereTriangulation.h and LayerLookup.h say how.
#include "bindings.glsl"

layout(binding = triangleOfDirectionUnit) uniform samplerCube triangleOfDirection;
// a row a triangle, a texel a corner
layout(binding = trianglesUnit) uniform sampler2DRect triangles;

struct LayerWeights {
  ivec3 index;
  vec3 weight;
};

// `v`: unit, tangent frame; below the horizon it counts as on it.
LayerWeights findLayers(vec3 v) {
#ifndef HAS_LAYERS
  return LayerWeights(ivec3(0), vec3(1.0, 0.0, 0.0));
#endif
  v = normalize(vec3(v.xy, max(v.z, 0.0)) + vec3(0.0, 0.0, 1e-12));
  vec3 p = vec3(v.xy / (1.0 + v.z), 1.0);
  int triangle = int(texture(triangleOfDirection, v).r);

  // xyz: what the weight is the dot product of p with; w: 1 + the index, negative where the edge
  // opposite of it is the hull.
  vec4 corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = texelFetch(triangles, ivec2(k, triangle));
  for (int k = 0; k < 3; ++k) {
    float slope = dot(corner[k].xy, p.xy);
    // Outside of the hull: towards the pole until the hull is met.
    if (corner[k].w < 0.0 && slope + corner[k].z < 0.0 && corner[k].z > 0.0) {
      p.xy *= -corner[k].z / slope;
      break;
    }
  }
  LayerWeights found;
  for (int k = 0; k < 3; ++k) {
    found.index[k] = int(abs(corner[k].w)) - 1;
    found.weight[k] = max(dot(corner[k].xyz, p), 0.0);
  }
  found.weight /= found.weight.x + found.weight.y + found.weight.z;
#ifdef NEAREST_LAYER
  vec3 w = found.weight;
  int best = w.x >= w.y && w.x >= w.z ? 0 : w.y >= w.z ? 1 : 2;
  found = LayerWeights(ivec3(found.index[best]), vec3(1.0, 0.0, 0.0));
#endif
  return found;
}
