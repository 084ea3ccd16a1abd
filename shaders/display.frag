#version 450
// A linear picture as a display shows it: exposed, tone-mapped as weft/core/ToneMapping.h says,
// encoded as sRGB.

layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform vec2 drawnShare;  // of the texture: the rest was not drawn
layout(location = 1) uniform float factor;
layout(location = 2) uniform bool soft;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 shown;

const float kLinear = 0.8, kRest = 1 - kLinear, kFading = 0.15;

vec3 toneMapped(vec3 radiance) {
  radiance = min(max(radiance, 0), 1e30);
  float peak = max(max(radiance.r, radiance.g), radiance.b);
  if (peak <= kLinear) return radiance;
  float highest = 1 - kRest * kRest / (peak - kLinear + kRest);
  float white = 1 - 1 / (1 + kFading * (peak - highest));
  return mix(radiance / peak * highest, vec3(highest), white);
}

vec3 encoded(vec3 linear) {
  linear = clamp(linear, 0, 1);
  vec3 curved = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
  return mix(curved, 12.92 * linear, lessThan(linear, vec3(0.0031308)));
}

void main() {
  vec2 halfTexel = 0.5 / vec2(textureSize(picture, 0));
  vec3 radiance = factor * texture(picture, min(place * drawnShare, drawnShare - halfTexel)).rgb;
  shown = vec4(encoded(soft ? toneMapped(radiance) : radiance), 1);
}
