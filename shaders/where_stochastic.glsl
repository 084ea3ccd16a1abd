// Where a field is looked up that covers a surface at random, without a map: three pieces of the
// sample around the vertices of a grid of triangles, and the sample's mean, which has the negative
// share that keeps the contrast of what is blended (StochasticTiling.h).

const float tilingEdge = 0.25;  // of a triangle, in samples
const float rootOf3 = sqrt(3.0);

struct Place {
  vec2 texcoord;  // 1 is the whole sample
  vec2 toRight;   // from a pixel to the next
  vec2 upwards;
};

struct PlaceShare {
  Place place;
  float share;  // of the result; not above 0 for the last
};

// What a pixel covers.
struct Footprint {
  Place place;
  ivec2 size;  // of the sample, in texels
  int count;   // of the places that are shaded
};

Footprint footprintOf(vec2 texcoord, ivec2 size) {
  return Footprint(Place(texcoord, dFdx(texcoord), dFdy(texcoord)), size, 4);
}

vec2 randomOf(ivec2 vertex) {
  uvec2 v = uvec2(vertex) * 1664525u + 1013904223u;
  for (int i = 0; i < 2; ++i) {
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
  }
  return vec2(v) * exp2(-32.0);
}

// Where the sample is looked up around a vertex of the grid.
vec2 pieceAround(ivec2 vertex, vec2 texcoord) {
  vec2 skewed = vec2(vertex);
  vec2 place = tilingEdge * vec2(skewed.x + 0.5 * skewed.y, 0.5 * rootOf3 * skewed.y);
  return randomOf(vertex) + texcoord - place;
}

PlaceShare placeAt(Footprint footprint, int index) {
  vec2 texcoord = footprint.place.texcoord, scaled = texcoord / tilingEdge;
  vec2 skewed = vec2(scaled.x - scaled.y / rootOf3, 2.0 / rootOf3 * scaled.y);
  ivec2 base = ivec2(floor(skewed));
  vec2 upper = skewed - vec2(base);
  float last = 1.0 - upper.x - upper.y;
  bool isFar = last < 0.0;
  vec3 weights = isFar ? vec3(-last, 1.0 - upper.yx) : vec3(last, upper);
  vec3 shares = weights / length(weights);
  // So large that one texel covers the sample.
  if (index == 3)
    return PlaceShare(Place(vec2(0.5), vec2(16.0, 0.0), vec2(0.0, 16.0)),
                      1.0 - shares.x - shares.y - shares.z);
  ivec2 vertex = base + (index == 0 ? ivec2(isFar) : ivec2(2 - index, index - 1));
  Place place = footprint.place;
  place.texcoord = pieceAround(vertex, texcoord);
#ifdef NEAREST_TEXEL
  vec2 size = vec2(footprint.size);
  place = Place((floor(place.texcoord * size) + 0.5) / size, vec2(0.0), vec2(0.0));
#endif
  return PlaceShare(place, shares[index]);
}
