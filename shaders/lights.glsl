// The per-frame block that the renderer fills (scenegraph/src/FrameBlock.h has the same layout).
// Points and directions have the world's axes; points are relative to the eye, since near it floats
// are finest. The place in the world: point + origin.xyz.
#include "bindings.glsl"

// How many lights there are of both kinds is known when a program is compiled, which makes short
// loops over them fast.
#ifndef DIRECTIONAL_LIGHTS
#define DIRECTIONAL_LIGHTS 0
#define PLACED_LIGHTS 0
#endif

const int maximumLights = 256;
const int maximumShadows = 8;
#ifdef SHOW_ALBEDO
const int lightCount = 1;  // along the normal
#else
const int lightCount = DIRECTIONAL_LIGHTS + PLACED_LIGHTS;
#endif

struct Light {
  // xyz: position; of the first DIRECTIONAL_LIGHTS the direction towards the light, unit
  vec4 place;
  vec4 intensity;  // rgb: candela for a position, lux for a direction; w: 1 / range^2
  // dot(cone, (direction from the light, 1)), in 0..1 and squared, is how much of it a spot gives.
  vec4 cone;
  // x: layer of its shadow map, below 0 for none; y: size of a texel, at distance 1 from what has
  // a position; zw: of a cube, depth = z - w / distance
  vec4 shadow;
};

layout(std140, binding = frameBinding) uniform Frame {
  mat4 viewProjection;
  // (0, 0, 0, 1); of an orthographic view the unit direction towards the viewer, w = 0
  vec4 eye;
  vec4 origin;  // the eye's place in the world
  Light lights[maximumLights];
  vec4 environmentRows[3];    // xyz: from world space to the environment, where there is one
  vec4 environmentIntensity;  // rgb; w: what prefiltered values are multiplied by
  mat4 shadowMatrices[maximumShadows];  // by layer: to the map, 0..1 in place and depth
};

// Which parts of what surfaces reflect are shown (RenderOptions).
#ifdef ONLY_SPECULAR
const float diffusePart = 0.0;
#else
const float diffusePart = 1.0;
#endif
#ifdef ONLY_DIFFUSE
const float specularPart = 0.0;
#else
const float specularPart = 1.0;
#endif

// The unit direction from a point towards the eye.
vec3 toEye(vec3 point) {
  return normalize(eye.xyz - eye.w * point);
}

#include "shadows.glsl"

// Irradiance, on a surface that faces the light, at a point; `toLight` becomes the unit direction
// towards it. `normal`: of the surface there, of any length; 0 for none.
vec3 lightAt(int index, vec3 point, vec3 normal, out vec3 toLight) {
#ifdef SHOW_ALBEDO
  toLight = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  if (dot(toLight, toEye(point)) < 0.0) toLight = -toLight;
  return vec3(3.14159265358979);
#endif
  if (index < DIRECTIONAL_LIGHTS) {
    toLight = lights[index].place.xyz;
    return lights[index].intensity.rgb * litShare(index, point, normal, toLight, 1.0);
  }
  Light light = lights[index];
  vec3 offset = light.place.xyz - point;
  float squared = max(dot(offset, offset), 1e-37);
  toLight = offset * inversesqrt(squared);
  float beyond = squared * light.intensity.w;
  float fade = clamp(1.0 - beyond * beyond, 0.0, 1.0);  // KHR_lights_punctual's
  float inCone = clamp(light.cone.w - dot(light.cone.xyz, toLight), 0.0, 1.0);
  float share = litShare(index, point, normal, toLight, sqrt(squared));
  return light.intensity.rgb * (share * fade * inCone * inCone / squared);
}
