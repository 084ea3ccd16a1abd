// Where a field is looked up, the nearest texel. A *where* stage says how many texels are shaded
// and which ones.

const int texelCount = 1;

struct TexelShare {
  ivec2 texel;
  float share;  // of the result
};

// `place`: in texels, 0..size.
TexelShare texelAt(int index, vec2 place, ivec2 size) {
  // fract() of a tiny negative number rounds to 1.
  return TexelShare(min(ivec2(place), size - 1), 1.0);
}
