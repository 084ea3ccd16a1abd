// No environment.

EnvironmentFrame environmentFrame(TangentFrame frame) {
  return EnvironmentFrame(0);
}

int nodeCount() {
  return 0;
}

vec3 nodeAt(int index, EnvironmentFrame frame, out vec3 light) {
  return light = vec3(0.0);
}

vec3 environmentValue(Texel texel, Layer layer, Place place, int index, vec3 view,
                      EnvironmentFrame frame) {
  return vec3(0.0);
}
