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
    vec3 onRing = vec3(normalize(l.xy) * sqrt(1.0 - lowestLightZ * lowestLightZ), lowestLightZ);
    return l.z / lowestLightZ * evaluateModel(shared_, view, onRing);
  }
  return evaluateModel(shared_, view, l);
#else
  return l.z * evaluateModel(shared_, view, l);
#endif
}

void main() {
  TangentFrame frame = tangentFrame(normal, tangent, handedness, !gl_FrontFacing);
  ivec2 size = textureSize(sharedParameters, 0);
  // fract() of a tiny negative number rounds to 1.
  ivec2 texel = min(ivec2(fract(texcoord * textureScale) * vec2(size)), size - 1);
  vec4 shared_ = texelFetch(sharedParameters, texel, 0);

  ViewWeights views = findViews(toFrame(frame, normalize(eye.xyz - position)));
#ifdef NEAREST_VIEW
  views = nearestView(views);
#endif
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
  color = vec4(radiance / 3.14159265358979, 1.0);
}
