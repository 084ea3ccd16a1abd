// What a fragment shader writes for a linear colour: the same, or encoded as sRGB where a renderer
// says that GL will not do so although the framebuffer is looked at as it is (PassiveWindow).
vec4 shown(vec4 linear) {
#ifdef ENCODE_SRGB
  vec3 value = clamp(linear.rgb, 0.0, 1.0);
  vec3 straight = 12.92 * value;
  vec3 curved = 1.055 * pow(max(value, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055;
  return vec4(mix(curved, straight, lessThanEqual(value, vec3(0.0031308))), linear.a);
#else
  return linear;
#endif
}
