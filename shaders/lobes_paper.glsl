// Lobes under an environment as [Meseth 2004] 5.2 has them, in place of lobes.glsl: as they are,
// times n.t, their exponents rounded to 2^(i / 2), i = 0..10, in parabolic maps.

// They are not prepared: this way takes a lobe's own direction and exponent.
#undef ENVIRONMENT_LAYERS

// A column of maps: for each i half around +z, half around -z.
layout(binding = environmentLobesUnit) uniform sampler2DRect environmentLobes;

float roundedExponent(float logExponent) {
  return clamp(round(2.0 * logExponent), 0.0, 10.0);
}

// The average over (d.l)^(2^logExponent); `d` in the environment, of any length.
vec3 averageOfLobe(vec3 d, float logExponent) {
  d = normalize(d);
  float side = float(textureSize(environmentLobes).x);
  vec2 p = 0.5 + 0.5 * d.xy / (1.0 + abs(d.z)) * (1.0 - 2.0 / side);
  float map = 2.0 * roundedExponent(logExponent) + (d.z < 0.0 ? 1.0 : 0.0);
  return texture(environmentLobes, side * (p + vec2(0.0, map))).rgb;
}

// The integral of light times (t.l)^exponent n.t, divided by pi; t in the tangent frame.
vec3 lightOfLobe(EnvironmentFrame frame, vec3 t, float exponent) {
  float logExponent = log2(exponent);
  float rounded = exp2(0.5 * roundedExponent(logExponent));
  return 2.0 / (rounded + 1.0) * max(t.z, 0.0) * averageOfLobe(frame.axes * t, logExponent);
}
