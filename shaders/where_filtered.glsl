// Where a field is looked up whose parameters the hardware filters: one place, and how far it moves
// from pixel to pixel, which says how coarse a level is enough.

struct Place {
  vec2 texcoord;  // 1 is the whole surface, which repeats
  vec2 toRight;   // from a pixel to the next
  vec2 upwards;
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

Footprint footprintOf(vec2 texcoord, ivec2 size) {
#ifdef NEAREST_TEXEL
  texcoord = (floor(texcoord * vec2(size)) + 0.5) / vec2(size);
  return Footprint(Place(texcoord, vec2(0.0), vec2(0.0)), 1);
#else
  return Footprint(Place(texcoord, dFdx(texcoord), dFdy(texcoord)), 1);
#endif
}

PlaceShare placeAt(Footprint footprint, int index) {
  return PlaceShare(footprint.place, 1.0);
}
