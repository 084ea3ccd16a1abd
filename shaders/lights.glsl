// The per-frame block that the renderer fills (scenegraph/src/FrameBlock.h has the same layout).

const int maximumLights = 16;

struct Light {
  vec4 place;      // xyz: position (w = 1), or direction towards the light, unit (w = 0); world space
  vec4 intensity;  // rgb: candela for a position, lux for a direction
};

layout(std140, binding = 0) uniform Frame {
  mat4 viewProjection;
  vec4 eye;  // xyz: world space
  ivec4 lightCount;  // x
  Light lights[maximumLights];
};

// Irradiance, on a surface that faces the light, at a world-space point; `toLight` becomes the unit direction towards it.
vec3 lightAt(int index, vec3 point, out vec3 toLight) {
  Light light = lights[index];
  vec3 offset = light.place.xyz - light.place.w * point;
  float squared = max(dot(offset, offset), 1e-12);
  toLight = offset * inversesqrt(squared);
  return light.place.w == 0.0 ? light.intensity.rgb : light.intensity.rgb / squared;
}
