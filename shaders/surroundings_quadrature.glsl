// An environment that is summed over the measured lights, where no formula integrates it
// (LightQuadrature).
#ifdef ENVIRONMENT

// xyz: a measured light; w: its share of the integral
layout(binding = quadratureUnit) uniform sampler2DRect quadrature;

EnvironmentFrame environmentFrame(TangentFrame frame) {
  EnvironmentFrame turned;
  turned.axes = mat3(toEnvironment(frame.t), toEnvironment(frame.b), toEnvironment(frame.n));
  return turned;
}

int nodeCount() {
  return textureSize(quadrature).x;
}

// The irradiance, divided by pi n.l, around a measured light.
vec3 nodeAt(int index, EnvironmentFrame frame, out vec3 light) {
  vec4 node = texelFetch(quadrature, ivec2(index, 0));
  light = node.xyz;
  vec3 average = averageOfLobe(frame.axes * light, log2(quadratureExponent));
  return environmentIntensity.w * environmentIntensity.rgb * (node.w / light.z) * average;
}

vec3 environmentValue(Texel texel, Layer layer, Place place, int index, vec3 view,
                      EnvironmentFrame frame) {
  return vec3(0.0);
}

#else
#include "surroundings_none.glsl"
#endif
