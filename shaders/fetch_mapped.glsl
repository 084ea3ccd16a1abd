// The numbers of a model whose parameters the hardware filters, fetched through a coordinate map.
//
// Where texels around a place lie side by side in the sample, too, the hardware filters there.
// Where the map jumps between them, each side is fetched by itself. At coarse levels the map jumps
// within texels: from some level on the surface has its own, which lie behind the sample's
// (MapTextures.h).
#include "filtered_texel.glsl"

// Fetches of the sample around a place: one, or two or four beside a jump.
struct Taps {
  ivec2 count;  // across, down
  ivec2 low;    // the first of the four texels of the surface
  vec2 upper;   // how far the place lies towards the others
};

// The texel of the sample that a texel of the surface or of its repetitions shows.
ivec2 shownAt(ivec2 texel) {
  ivec2 surface = surfaceSize();
  return shownTexel((texel + surface) % surface);
}

Taps tapsAround(vec2 texcoord) {
  vec2 place = fract(texcoord) * vec2(surfaceSize()) - 0.5;
  ivec2 low = ivec2(floor(place)), field = fieldSize();
  const ivec2 across = ivec2(1, 0), down = ivec2(0, 1);
  ivec2 first = shownAt(low), right = shownAt(low + across), below = shownAt(low + down);
  ivec2 last = shownAt(low + 1);
  bool isWholeAcross = right == (first + across) % field && last == (below + across) % field;
  bool isWholeDown = below == (first + down) % field && last == (right + down) % field;
  return Taps(ivec2(isWholeAcross ? 1 : 2, isWholeDown ? 1 : 2), low, place - vec2(low));
}

// Where a tap lies on the sample, and its share.
vec2 placeOfTap(Taps taps, int index, out float share) {
  ivec2 corner = ivec2(index % taps.count.x, index / taps.count.x);
  bvec2 isWhole = equal(taps.count, ivec2(1));
  vec2 shares = mix(mix(1.0 - taps.upper, taps.upper, vec2(corner)), vec2(1.0), isWhole);
  share = shares.x * shares.y;
  vec2 within = mix(vec2(0.0), taps.upper, isWhole);
  return (vec2(shownAt(taps.low + corner)) + 0.5 + within) / vec2(fieldSize());
}

// What part of a pixel comes from the surface's own levels: all from where their finest is as fine
// as pixels are. They have as many texels as the sample.
float coarseShare(vec2 toRight, vec2 upwards) {
  vec2 ratio = vec2(surfaceSize()) / vec2(fieldSize());
  float finest = max(log2(max(ratio.x, ratio.y)), 1.0);
  float level = 0.5 * log2(max(max(dot(toRight, toRight), dot(upwards, upwards)), 1e-20));
  return clamp(level - finest + 1.0, 0.0, 1.0);
}

// Adds a share of what lies at a place of the sample (0), or of the surface's own levels (1).
void addTexel(inout Texel sum, float share, Place place, int field) {
  vec3 color =
      textureGrad(baseColors, vec3(place.texcoord, field), place.toRight, place.upwards).rgb;
  sum.baseColor += share * color;
  int i = 0;
  do {
    sum.weights[i] +=
        share * textureGrad(sharedParameters, vec3(place.texcoord, field * SHARED_TEXELS + i),
                            place.toRight, place.upwards);
  } while (++i < sum.count);
}

Texel fetchTexel(Place place) {
  place = narrowed(place);
  // in texels
  vec2 toRight = place.toRight * vec2(surfaceSize()), upwards = place.upwards * vec2(surfaceSize());
  float coarse = coarseShare(toRight, upwards);
  // Between the levels of both the sample's finer one is mixed with the surface's.
  vec2 finer = exp2(-coarse) / vec2(fieldSize());
  Taps taps = tapsAround(place.texcoord);
  int count = coarse < 1.0 ? taps.count.x * taps.count.y : 0;
  int fetches = count + (coarse > 0.0 ? 1 : 0);
  Texel texel;
  texel.baseColor = vec3(0.0);
  // The surface's own levels have all.
  texel.count = coarse > 0.0 ? SHARED_TEXELS : weightsAt(place.toRight, place.upwards);
  for (int i = 0; i < SHARED_TEXELS; ++i) texel.weights[i] = vec4(0.0);
  int tap = 0;
  // One loop that is tested at its end: Mesa's software renderer executes what lies behind a
  // condition wherever it is, but ends a loop once all neighbours have.
  do {
    float share = coarse;
    Place fetched = place;
    if (tap < count) {
      fetched.texcoord = placeOfTap(taps, tap, share);
      fetched.toRight = toRight * finer;
      fetched.upwards = upwards * finer;
      share *= 1.0 - coarse;
    }
    addTexel(texel, share, fetched, tap < count ? 0 : 1);
  } while (++tap < fetches);
  return texel;
}
