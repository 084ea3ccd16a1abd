// Vertex stage of every material: world-space position and tangent frame.
#version 450 core
#include "lights.glsl"

layout(std140, binding = 1) uniform Object {
  mat4 model;
  mat4 normalMatrix;  // inverse transpose of model
};

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec2 inTexcoord;

out vec3 position;
out vec3 normal;
out vec3 tangent;
out vec2 texcoord;
flat out float handedness;  // +1 or -1: of the bitangent, which points up the image

void main() {
  vec4 world = model * vec4(inPosition, 1.0);
  position = world.xyz;
  normal = mat3(normalMatrix) * inNormal;
  tangent = mat3(model) * inTangent.xyz;
  // A mirroring transform turns the handedness of the whole frame.
  handedness = inTangent.w * sign(determinant(mat3(model)));
  texcoord = inTexcoord;
  gl_Position = viewProjection * world;
}
