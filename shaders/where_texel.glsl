// Where a field is looked up, the nearest texel. A *where* stage says how many texels are shaded
// and which ones.

const int placeCount = 1;

struct Place {
  ivec2 texel;
};

struct PlaceShare {
  Place place;
  float share;  // of the result
};

// `texcoord`: 1 is the whole surface, of `size` texels, which repeats.
PlaceShare placeAt(int index, vec2 texcoord, ivec2 size) {
  // fract() of a tiny negative number rounds to 1.
  return PlaceShare(Place(shownTexel(min(ivec2(fract(texcoord) * vec2(size)), size - 1))), 1.0);
}
