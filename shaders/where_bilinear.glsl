// Where a field is looked up, the four texels around a place: lobes cannot be mixed, what they give
// can.

const int placeCount = 4;

struct Place {
  ivec2 texel;
};

struct PlaceShare {
  Place place;
  float share;  // of the result
};

// `texcoord`: 1 is the whole surface, of `size` texels, which repeats.
PlaceShare placeAt(int index, vec2 texcoord, ivec2 size) {
  vec2 place = fract(texcoord) * vec2(size);
  vec2 low = floor(place - 0.5);
  vec2 upper = place - 0.5 - low;
  ivec2 corner = ivec2(index & 1, index >> 1);
  vec2 weight = mix(1.0 - upper, upper, vec2(corner));
  return PlaceShare(Place(shownTexel((ivec2(low) + corner + size) % size)), weight.x * weight.y);
}
