// How much of a surface a pixel covers.

// The squared side of the square of texels that is averaged for a pixel, from its steps to the
// right and up, in texels: a square of the same area. By the longer side what is seen at a low
// angle would blur; a quarter of that is the least, so that it does not flicker.
float squaredSide(vec2 toRight, vec2 upwards) {
  float area = abs(toRight.x * upwards.y - toRight.y * upwards.x);
  float longest = max(dot(toRight, toRight), dot(upwards, upwards));
  return max(area, longest / 16.0);
}
