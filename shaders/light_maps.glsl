// Tables over the directions of light that all texels share.

// LightMap.h: the place of a light in a square of so many texels a side, in texels.
vec2 lightMapTexel(vec3 light, float side) {
  vec2 disc = clamp(light.xy * inversesqrt(1.0 + max(light.z, 0.0)), -1.0, 1.0);
  return (0.5 * disc + 0.5) * (side - 1.0) + 0.5;
}

// What a term of the light contributes to four channels, in a row of a table of polynomials.
vec4 polynomialTexel(sampler2DArray polynomials, int term, int row, int channels) {
  // Mesa's software renderer takes longer for texelFetch().
  vec2 place = (vec2(term, row) + 0.5) / vec2(textureSize(polynomials, 0).xy);
  return textureLod(polynomials, vec3(place, channels), 0.0);
}
