// Lobes under an environment: of each the part above the horizon, times n.l, as one lobe
// (CosineLobe.h), between exponents. LobeLookup says which file takes this one's place.

// Octahedral; along z log2 of the exponent, ENVIRONMENT_LOBES an octave.
layout(binding = environmentLobesUnit) uniform sampler3D environmentLobes;

// The average over (d.l)^(2^logExponent); `d` in the environment, of any length.
vec3 averageOfLobe(vec3 d, float logExponent) {
  return layerOf(environmentLobes, d, float(ENVIRONMENT_LOBES) * max(logExponent, 0.0));
}

// The integral of light times (t.l)^exponent n.l, divided by pi; t in the tangent frame.
vec3 lightOfLobe(EnvironmentFrame frame, vec3 t, float exponent) {
  // CosineLobe.cpp: lobeAboveHorizon().
  float narrow = 1.0 / (exponent + 2.0);
  float mean = t.z * (1.0 - narrow);
  float spread = 0.6366 * max(1.0 - t.z * t.z, 0.0) * narrow * (1.0 - 0.42 * narrow);
  float squared = mean * mean + spread;
  float inverse = inversesqrt(squared);
  float root = squared * inverse;
  float cut = spread * inverse * inverse;
  float facing =
      max(0.5 * (mean + root) - 0.25 * root * cut * (1.0 - cut) * (1.0 - 0.5 * cut), 0.0);
  float shift =
      narrow * inverse * (1.0 + 0.85 * narrow * cut * cut) *
      (mean < 0.0 ? 1.0 + 1.85 * (1.0 - cut) : 1.0);
  float below = 0.5 - 0.5 * mean * inverse;
  vec3 direction = frame.axes * (t + shift * (vec3(0.0, 0.0, 1.0) - t.z * t));
  return 2.0 / (exponent + 1.0) * facing *
         averageOfLobe(direction, log2(exponent + 1.0) + below * (1.05 + 1.37 * narrow));
}
