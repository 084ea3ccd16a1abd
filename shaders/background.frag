// The environment itself, behind what it lights.
#version 450 core
#include "lights.glsl"
#include "environment.glsl"
#include "shown.glsl"

// Environment.h says which direction lies where
layout(binding = panoramaUnit) uniform sampler2D panorama;

in vec3 direction;

layout(location = 0) out vec4 color;

void main() {
  vec3 d = normalize(toEnvironment(direction));
  vec2 place = vec2(0.5 + atan(d.x, -d.z) / 6.28318530717959,
                    acos(clamp(d.y, -1.0, 1.0)) / 3.14159265358979);
  color = shown(vec4(environmentIntensity.rgb * textureLod(panorama, place, 0.0).rgb, 1.0));
}
