// A diffuse surface: radiance = baseColor / pi x irradiance x n.l, seen alike from all sides.
#version 450 core
#include "lights.glsl"
#include "environment.glsl"
#include "shown.glsl"

layout(std140, binding = materialBinding) uniform Lambert {
  vec4 baseColor;  // linear
};
#ifdef BASE_COLOR_TEXTURE
layout(binding = baseColorUnit) uniform sampler2D baseColorTexture;
#endif

in vec3 position;
in vec3 normal;
in vec2 texcoord;

layout(location = 0) out vec4 color;

void main() {
  vec4 albedo = baseColor;
#ifdef BASE_COLOR_TEXTURE
  albedo *= texture(baseColorTexture, texcoord);
#endif
  vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  if (!gl_FrontFacing) n = -n;
  vec3 irradiance = vec3(0.0);
  for (int i = 0; i < lightCount; ++i) {
    vec3 toLight;
    vec3 facing = lightAt(i, position, normal, toLight);
    irradiance += facing * max(dot(n, toLight), 0.0);
  }
  vec3 radiance = irradiance / 3.14159265358979;
#ifdef ENVIRONMENT
  radiance += environmentIntensity.w * environmentIntensity.rgb * diffuseAround(toEnvironment(n));
#endif
  vec4 light = vec4(diffusePart * albedo.rgb * radiance, albedo.a);
  color = shownSurface(light, position, normal, texcoord);
}
