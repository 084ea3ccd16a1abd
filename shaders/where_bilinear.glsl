// Where a field is looked up, the four texels around a place: lobes cannot be mixed, what they give
// can.

const int texelCount = 4;

struct TexelShare {
  ivec2 texel;
  float share;  // of the result
};

// `place`: in texels, 0..size; the material repeats.
TexelShare texelAt(int index, vec2 place, ivec2 size) {
  vec2 low = floor(place - 0.5);
  vec2 upper = place - 0.5 - low;
  ivec2 corner = ivec2(index & 1, index >> 1);
  vec2 weight = mix(1.0 - upper, upper, vec2(corner));
  return TexelShare((ivec2(low) + corner + size) % size, weight.x * weight.y);
}
