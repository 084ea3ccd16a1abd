// Where a field is looked up whose parameters the hardware filters: one place, and how far it moves
// from pixel to pixel, which says how coarse a level is enough.

const int placeCount = 1;

struct Place {
  vec2 texcoord;  // 1 is the whole surface, which repeats
  vec2 toRight;   // from a pixel to the next
  vec2 upwards;
};

struct PlaceShare {
  Place place;
  float share;  // of the result
};

PlaceShare placeAt(int index, vec2 texcoord, ivec2 size) {
#ifdef NEAREST_TEXEL
  return PlaceShare(Place((floor(texcoord * vec2(size)) + 0.5) / vec2(size), vec2(0.0), vec2(0.0)),
                    1.0);
#else
  return PlaceShare(Place(texcoord, dFdx(texcoord), dFdy(texcoord)), 1.0);
#endif
}
