// Where a field is looked up whose levels are summed: one place of the sample, and from its size on
// the screen the level of detail: 0 where a texel covers a pixel or more, 1 where two a side do.

ivec2 fieldSize();

const int placeCount = 1;

struct Place {
  vec2 texcoord;  // of the sample, which repeats
  float detail;
};

struct PlaceShare {
  Place place;
  float share;  // of the result
};

// `texcoord`: 1 is the whole surface, of `size` texels, which repeats.
PlaceShare placeAt(int index, vec2 texcoord, ivec2 size) {
  vec2 toRight = dFdx(texcoord) * vec2(size), upwards = dFdy(texcoord) * vec2(size);
  vec2 place = fract(texcoord) * vec2(size);
  ivec2 texel = min(ivec2(place), size - 1);
#ifdef NEAREST_TEXEL
  return PlaceShare(Place((vec2(shownTexel(texel)) + 0.5) / vec2(fieldSize()), 0.0), 1.0);
#else
  float largest = max(dot(toRight, toRight), dot(upwards, upwards));
  place += vec2(shownTexel(texel) - texel);
  return PlaceShare(Place(place / vec2(fieldSize()), 0.5 * log2(max(largest, 1.0))), 1.0);
#endif
}
