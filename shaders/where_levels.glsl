// Where a field is looked up whose levels are summed: one place of the sample, and from its size on
// the screen the level of detail: 0 where a texel covers a pixel or more, 1 where two a side do.

#include "footprint.glsl"

ivec2 fieldSize();

struct Place {
  vec2 texcoord;  // of the sample, which repeats
  float detail;
};

struct PlaceShare {
  Place place;
  float share;  // of the result
};

// What a pixel covers.
struct Footprint {
  Place place;
  int count;  // of the places that are shaded
};

// `texcoord`: 1 is the whole surface, of `size` texels, which repeats.
Footprint footprintOf(vec2 texcoord, ivec2 size) {
  vec2 toRight = dFdx(texcoord) * vec2(size), upwards = dFdy(texcoord) * vec2(size);
  vec2 place = fract(texcoord) * vec2(size);
  ivec2 texel = min(ivec2(place), size - 1);
#ifdef NEAREST_TEXEL
  return Footprint(Place((vec2(shownTexel(texel)) + 0.5) / vec2(fieldSize()), 0.0), 1);
#else
  place += vec2(shownTexel(texel) - texel);
  float squared = max(squaredSide(toRight, upwards), 1.0);
  return Footprint(Place(place / vec2(fieldSize()), 0.5 * log2(squared)), 1);
#endif
}

PlaceShare placeAt(Footprint footprint, int index) {
  return PlaceShare(footprint.place, 1.0);
}
