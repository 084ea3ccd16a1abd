// Shading a field whose layers are measured views: the same layers for all lights.
#include "field_value.glsl"
#include "incoming.glsl"

vec3 variedDirection(vec3 light, vec3 view) {
  return light;
}

// The radiance towards the eye that one texel would give here.
vec3 radianceOf(Place place, vec3 view, TangentFrame frame, EnvironmentFrame environment) {
  vec3 seenFrom = notBelow(view, lowestViewZ);
  LayerWeights layers = findLayers(view);
  place = seenAt(place, layers, view);
  Texel texel = fetchTexel(place);
  vec3 radiance = vec3(0.0);
  for (int k = 0; k < 3; ++k) {
    if (layers.weight[k] == 0.0) continue;
    int index = layers.index[k];
    radiance += layers.weight[k] * environmentValue(texel, fetchLayer(place, index), place, index,
                                                    seenFrom, environment);
  }
  if (incomingCount() == 0) return radiance;
  int i = 0;
  do {
    vec3 l;
    vec3 light = incomingAt(i, frame, environment, l);
    if (l.z <= 0.0) continue;
    for (int k = 0; k < 3; ++k)
      if (layers.weight[k] > 0.0)
        radiance += layers.weight[k] * light *
                    valueWithCosine(texel, fetchLayer(place, layers.index[k]), l, seenFrom);
  } while (++i < incomingCount());
  return radiance;
}
