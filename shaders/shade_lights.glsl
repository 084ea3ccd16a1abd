// Shading a field whose layers are measured lights: each light has its own layers.
#include "field_value.glsl"
#include "incoming.glsl"

vec3 variedDirection(vec3 light, vec3 view) {
  return view;
}

// The radiance towards the eye that one texel would give here.
vec3 radianceOf(Place place, vec3 view, TangentFrame frame, EnvironmentFrame environment) {
  Texel texel = fetchTexel(place);
  vec3 seenFrom = notBelow(view, lowestViewZ);
  vec3 radiance = vec3(0.0);
  if (incomingCount() == 0) return radiance;
  int i = 0;
  do {
    vec3 l;
    vec3 light = incomingAt(i, frame, environment, l);
    if (l.z <= 0.0) continue;
    LayerWeights layers = findLayers(l);
    // Sampled at measured lights, two of three weights are no more than rounding.
    for (int k = 0; k < 3; ++k)
      if (layers.weight[k] > 2e-6)
        radiance += layers.weight[k] * light *
                    valueWithCosine(texel, fetchLayer(place, layers.index[k]), l, seenFrom);
  } while (++i < incomingCount());
  return radiance;
}
