// All light that a field is summed over: the frame's lights, then what an environment is sampled
// at.
#include "surroundings.glsl"

int incomingCount() {
  return lightCount + nodeCount();
}

// What a value, n.l included, is multiplied by; `direction`, tangent frame, becomes where it comes
// from.
vec3 incomingAt(int index, TangentFrame frame, EnvironmentFrame environment, out vec3 direction) {
  if (index >= lightCount) return nodeAt(index - lightCount, environment, direction);
  vec3 toLight;
  vec3 irradiance = lightAt(index, position, normal, toLight);
  direction = toFrame(frame, toLight);
  return irradiance / 3.14159265358979;
}
