// The numbers of a model whose parameters the hardware filters, fetched from the measured sample.
#include "filtered_texel.glsl"

Texel fetchTexel(Place place) {
  place = narrowed(place);
  Texel texel;
  texel.baseColor =
      textureGrad(baseColors, vec3(place.texcoord, 0.0), place.toRight, place.upwards).rgb;
  texel.count = weightsAt(place.toRight, place.upwards);
  int i = 0;
  do {
    texel.weights[i] =
        textureGrad(sharedParameters, vec3(place.texcoord, i), place.toRight, place.upwards);
  } while (++i < texel.count);
  return texel;
}
