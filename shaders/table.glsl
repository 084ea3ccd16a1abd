// Bilinear between values of which the first and last lie at 0 and 1.
vec3 valueOfTable(sampler2D table, vec2 place) {
  vec2 size = vec2(textureSize(table, 0));
  return textureLod(table, (place * (size - 1.0) + 0.5) / size, 0.0).rgb;
}
