// The surface that texture coordinates run over: the measured sample itself.

ivec2 fieldSize();

// In texels.
ivec2 surfaceSize() {
  return fieldSize();
}

// The texel of the sample that a texel of the surface shows.
ivec2 shownTexel(ivec2 texel) {
  return texel;
}
