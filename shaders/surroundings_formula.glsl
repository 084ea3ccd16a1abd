// An environment that the model's own formula integrates.
#ifdef ENVIRONMENT

#ifdef ENVIRONMENT_LAYERS
// FieldTextures::preparedLayers.
layout(binding = preparedParametersUnit) uniform sampler2DArray preparedParameters;
#endif

EnvironmentFrame environmentFrame(TangentFrame frame) {
  EnvironmentFrame turned;
  turned.axes = mat3(toEnvironment(frame.t), toEnvironment(frame.b), toEnvironment(frame.n));
  prepareEnvironment(turned);
  return turned;
}

int nodeCount() {
  return 0;
}

vec3 nodeAt(int index, EnvironmentFrame frame, out vec3 light) {
  return light = vec3(0.0);
}

// What one layer shows; each colour channel of a fit in RGB has lobes of its own.
vec3 environmentValue(Texel texel, Layer layer, Place place, int index, vec3 view,
                      EnvironmentFrame frame) {
#ifdef MODEL_GIVES_COLOR
  return environmentIntensity.w * environmentIntensity.rgb *
         colorUnderEnvironment(texel, layer, view, frame);
#else
#ifdef ENVIRONMENT_LAYERS
  layer = fetchLayerFrom(preparedParameters, place, index);
#endif
  vec3 value = underEnvironment(texel.channels[0], layer.channels[0], view, frame);
  for (int c = 1; c < COLOR_CHANNELS; ++c)
    value[c] = underEnvironment(texel.channels[c], layer.channels[c], view, frame)[c];
  return environmentIntensity.w * environmentIntensity.rgb * value *
         texel.channels[0].texels[0].rgb;
#endif
}

#else
#include "surroundings_none.glsl"
#endif
