// Where a field is looked up, the four texels around a place, of one level or of the two between
// which a pixel's size lies: lobes cannot be mixed, what they give can.
#include "footprint.glsl"

ivec2 fieldSize();
int fieldLevels();

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
  vec2 surface;   // 1 is the whole surface, of `size` texels, which repeats
  vec2 ofSample;  // the same place on the sample, likewise; for coarser levels
  ivec2 size;
  int level;      // the finer of the two
  float coarser;  // what the other one counts
  int count;      // of the places that are shaded
};

// The place on the sample that a place of the surface shows.
vec2 shownPlace(vec2 place, ivec2 size) {
  ivec2 texel = min(ivec2(place), size - 1);
  return (place + vec2(shownTexel(texel) - texel)) / vec2(fieldSize());
}

Footprint footprintOf(vec2 texcoord, ivec2 size) {
  float squared = squaredSide(dFdx(texcoord) * vec2(size), dFdy(texcoord) * vec2(size));
  // Four texels around a place are already an average: half a level finer comes closer to that of
  // the pixel.
  float detail = clamp(0.5 * log2(max(squared, 1.0)) - 0.5, 0.0, float(fieldLevels() - 1));
  int level = int(detail);
  float coarser = detail - float(level);
  vec2 surface = fract(texcoord);
  // One level suffices where the other one would not be seen.
  return Footprint(surface, shownPlace(surface * vec2(size), size), size, level, coarser,
                   coarser < 0.01 ? 4 : 8);
}

PlaceShare placeAt(Footprint footprint, int index) {
  bool isFiner = index < 4;
  int level = isFiner ? footprint.level : footprint.level + 1;
  ivec2 size = level == 0 ? footprint.size : max(fieldSize() >> level, 1);
  vec2 place = (level == 0 ? footprint.surface : footprint.ofSample) * vec2(size);
  vec2 low = floor(place - 0.5);
  vec2 upper = place - 0.5 - low;
  ivec2 corner = ivec2(index & 1, index >> 1 & 1);
  vec2 weight = mix(1.0 - upper, upper, vec2(corner));
  ivec2 texel = (ivec2(low) + corner + size) % size;
  float ofLevel = isFiner ? 1.0 - footprint.coarser : footprint.coarser;
  return PlaceShare(Place(level == 0 ? shownTexel(texel) : texel, level),
                    ofLevel * weight.x * weight.y);
}
