// A reflectance field under point and directional lights: paper M eq. 4.
#version 450 core
#include "lights.glsl"
#include "tangent_frame.glsl"
#include "model.glsl"
#include "view_lookup.glsl"

layout(binding = 0) uniform sampler2DArray viewParameters;
layout(binding = 1) uniform sampler2D sharedParameters;

layout(std140, binding = 2) uniform ReflectanceField {
  vec2 textureScale;   // repetitions per unit of texture coordinates
  float lowestLightZ;  // of the measured lights; where a field that contains n.l ends
};

in vec3 position;
in vec3 normal;
in vec3 tangent;
in vec2 texcoord;
flat in float handedness;

layout(location = 0) out vec4 color;

// The value, n.l included, for light from `l` above the horizon (ReflectanceField.h: evaluateWithCosine).
vec3 evaluateWithCosine(vec4 shared_, ViewParameters view, vec3 l) {
#ifdef MODEL_HAS_COSINE
  if (l.z < lowestLightZ) {
    // 0 where rounding lets the pole lie below a ring at the pole.
    vec2 azimuth = l.xy * inversesqrt(max(dot(l.xy, l.xy), 1e-30));
    vec3 onRing = vec3(azimuth * sqrt(1.0 - lowestLightZ * lowestLightZ), lowestLightZ);
    return l.z / lowestLightZ * evaluateModel(shared_, view, onRing);
  }
  return evaluateModel(shared_, view, l);
#else
  return l.z * evaluateModel(shared_, view, l);
#endif
}

// The radiance towards the eye that one texel would give here.
vec3 radianceOf(ivec2 texel, ViewWeights views, TangentFrame frame) {
  vec4 shared_ = texelFetch(sharedParameters, texel, 0);
  vec3 radiance = vec3(0.0);
  for (int k = 0; k < 3; ++k) {
    if (views.weight[k] == 0.0) continue;
    ViewParameters view = fetchView(viewParameters, texel, views.view[k]);
    for (int i = 0; i < lightCount.x; ++i) {
      vec3 toLight;
      vec3 irradiance = lightAt(i, position, toLight);
      vec3 l = toFrame(frame, toLight);
      if (l.z > 0.0) radiance += views.weight[k] * irradiance * evaluateWithCosine(shared_, view, l);
    }
  }
  return radiance / 3.14159265358979;
}

void main() {
  TangentFrame frame = tangentFrame(normal, tangent, handedness, !gl_FrontFacing);
  ViewWeights views = findViews(toFrame(frame, normalize(eye.xyz - position)));
#ifdef NEAREST_VIEW
  views = nearestView(views);
#endif
  ivec2 size = textureSize(sharedParameters, 0);
  vec2 place = fract(texcoord * textureScale) * vec2(size);
#ifdef BILINEAR
  // Lobes cannot be mixed, what they give can.
  vec2 low = floor(place - 0.5);
  vec2 share = place - 0.5 - low;
  vec3 radiance = vec3(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    ivec2 offset = ivec2(corner & 1, corner >> 1);
    vec2 weight = mix(1.0 - share, share, vec2(offset));
    radiance += weight.x * weight.y * radianceOf((ivec2(low) + offset + size) % size, views, frame);
  }
#else
  // fract() of a tiny negative number rounds to 1.
  vec3 radiance = radianceOf(min(ivec2(place), size - 1), views, frame);
#endif
  color = vec4(radiance, 1.0);
}
