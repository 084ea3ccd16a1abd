// The surface that texture coordinates run over: a larger one, made of the measured sample's texels
// by a coordinate map.
#include "bindings.glsl"

layout(binding = coordinatesUnit) uniform usampler2D coordinates;

// In texels.
ivec2 surfaceSize() {
  return textureSize(coordinates, 0);
}

// The texel of the sample that a texel of the surface shows.
ivec2 shownTexel(ivec2 texel) {
  return ivec2(texelFetch(coordinates, texel, 0).xy);
}
