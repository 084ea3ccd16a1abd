// The microfacets of glTF 2.0's materials (appendix B).

// D V of GGX with Smith's height-correlated shadowing, per steradian. 1 - (n.h)^2 comes from a
// cross product because it cancels out at the peak of smooth surfaces.
float microfacets(float alpha, vec3 n, vec3 h, float nl, float nv) {
  float squared = alpha * alpha;
  vec3 across = cross(n, h);
  float nh = dot(n, h);
  if (nh <= 0.0) return 0.0;
  float width = dot(across, across) + squared * nh * nh;
  float shadowing = nl * sqrt(nv * nv * (1.0 - squared) + squared) +
                    nv * sqrt(nl * nl * (1.0 - squared) + squared);
  return squared / (3.14159265358979 * width * width) * 0.5 / shadowing;
}
