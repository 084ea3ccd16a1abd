#version 450
// One triangle over all of the viewport.

layout(location = 0) out vec2 place;  // (0, 0) at the lower left, (1, 1) at the upper right
out gl_PerVertex { vec4 gl_Position; };

void main() {
  place = vec2(gl_VertexID == 1 ? 2 : 0, gl_VertexID == 2 ? 2 : 0);
  gl_Position = vec4(2 * place - 1, 0, 1);
}
