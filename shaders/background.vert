// A triangle that covers the picture, behind everything: the direction in which each pixel looks.
#version 450 core
#include "lights.glsl"

out vec3 direction;  // world space, of any length

void main() {
  vec2 place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  // Rows of the projection times the view: right and up, longer the narrower the view, and forward,
  // 0 where it is orthographic.
  mat4 rows = transpose(viewProjection);
  vec3 right = rows[0].xyz / dot(rows[0].xyz, rows[0].xyz);
  vec3 up = rows[1].xyz / dot(rows[1].xyz, rows[1].xyz);
  direction = eye.w == 0.0 ? -eye.xyz : rows[3].xyz + place.x * right + place.y * up;
  // depth passes only where nothing was drawn
  gl_Position = vec4(place, 1.0 - 1.0 / 4194304.0, 1.0);
}
