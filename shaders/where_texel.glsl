// Where a field is looked up, the nearest texel of the finest level. A *where* stage says how many
// texels are shaded for a pixel, and which ones.

struct Place {
  ivec2 texel;  // of the sample
  int level;
};

struct PlaceShare {
  Place place;
  float share;  // of the result
};

// What a pixel covers.
struct Footprint {
  vec2 texcoord;  // 1 is the whole surface, of `size` texels, which repeats
  ivec2 size;
  int count;  // of the places that are shaded
};

Footprint footprintOf(vec2 texcoord, ivec2 size) {
  return Footprint(texcoord, size, 1);
}

PlaceShare placeAt(Footprint footprint, int index) {
  ivec2 size = footprint.size;
  // fract() of a tiny negative number rounds to 1.
  ivec2 texel = min(ivec2(fract(footprint.texcoord) * vec2(size)), size - 1);
  return PlaceShare(Place(shownTexel(texel), 0), 1.0);
}
