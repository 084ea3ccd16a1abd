// The model `rfp`: RfpModel.h has the formula. Two texels a view: a0..a3, a4 a5.

const int texelsPerView = 2;

struct ViewParameters {
  vec4 a0123;
  vec2 a45;
};

ViewParameters fetchView(sampler2DArray parameters, ivec2 texel, int view) {
  ViewParameters p;
  p.a0123 = texelFetch(parameters, ivec3(texel, view * texelsPerView), 0);
  p.a45 = texelFetch(parameters, ivec3(texel, view * texelsPerView + 1), 0).xy;
  return p;
}

// Linear RGB for light from `l` (tangent frame), clamped at 0; with or without n.l, as it was fitted.
vec3 evaluateModel(vec4 shared_, ViewParameters p, vec3 l) {
  float polynomial = dot(p.a0123, vec4(l.x * l.x, l.y * l.y, l.x * l.y, l.x)) + p.a45.x * l.y + p.a45.y;
  return max(polynomial, 0.0) * shared_.rgb;
}
