// Which measured views a view direction lies between, and their weights: HemisphereTriangulation.h and ViewLookup.h say how.

layout(binding = 2) uniform samplerCube triangleOfDirection;
layout(binding = 3) uniform sampler2DRect triangles;  // a row a triangle, a texel a corner

struct ViewWeights {
  ivec3 view;
  vec3 weight;
};

// `v`: unit, tangent frame; below the horizon it counts as on it.
ViewWeights findViews(vec3 v) {
  v = normalize(vec3(v.xy, max(v.z, 0.0)) + vec3(0.0, 0.0, 1e-12));
  vec3 p = vec3(v.xy / (1.0 + v.z), 1.0);
  int triangle = int(texture(triangleOfDirection, v).r);

  // xyz: what the weight is the dot product of p with; w: 1 + the view, negative where the edge opposite of it is the hull.
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
  ViewWeights found;
  for (int k = 0; k < 3; ++k) {
    found.view[k] = int(abs(corner[k].w)) - 1;
    found.weight[k] = max(dot(corner[k].xyz, p), 0.0);
  }
  found.weight /= found.weight.x + found.weight.y + found.weight.z;
  return found;
}

// The view of the largest weight alone.
ViewWeights nearestView(ViewWeights found) {
  int best = found.weight.x >= found.weight.y && found.weight.x >= found.weight.z ? 0 : found.weight.y >= found.weight.z ? 1 : 2;
  return ViewWeights(ivec3(found.view[best]), vec3(1.0, 0.0, 0.0));
}
