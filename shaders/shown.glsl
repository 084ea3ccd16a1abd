// What a fragment shader writes of a surface: its light, linear, or encoded as sRGB where a
// renderer says that GL will not do so although the framebuffer is looked at as it is
// (PassiveWindow); or what else is to be shown (RenderOptions::shown). Needs lights.glsl.
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

#if defined(SHOW_NORMAL) || defined(SHOW_DEPTH) || defined(SHOW_TEXTURE_COORDINATES) || \
    defined(SHOW_ALBEDO)
const bool showsLight = false;
#else
const bool showsLight = true;
#endif

vec4 shownSurface(vec4 linear, vec3 point, vec3 n, vec2 place) {
#if defined(SHOW_NORMAL)
  n *= inversesqrt(max(dot(n, n), 1e-30));
  return vec4(dot(n, toEye(point)) < 0.0 ? -n : n, 1.0);
#elif defined(SHOW_DEPTH)
  float depth = eye.w == 0.0 ? -dot(eye.xyz, point) : 1.0 / gl_FragCoord.w;
  return vec4(vec3(depth), 1.0);
#elif defined(SHOW_TEXTURE_COORDINATES)
  return vec4(place, 0.0, 1.0);
#elif defined(SHOW_ALBEDO)
  return vec4(linear.rgb, 1.0);
#else
  return shown(linear);
#endif
}
