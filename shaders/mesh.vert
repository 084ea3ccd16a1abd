// Vertex stage of every material: world-space position and tangent frame.
#version 450 core
#include "lights.glsl"

// Filled by the renderer for each thing that it draws (scenegraph/src/FrameBlock.h has the same layout).
layout(std140, binding = 1) uniform Object {
  mat4 model;
  mat4 normalMatrix;  // inverse transpose of model, but for a positive factor
};

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec2 inTexcoord;
layout(location = 4) in vec2 inTexcoord1;
layout(location = 5) in vec4 inColor;

out vec3 position;
out vec3 normal;
out vec3 tangent;
out vec2 texcoord;
out vec2 texcoord1;
out vec4 vertexColor;  // linear
flat out float handedness;  // +1 or -1: of the bitangent, which points up the image

void main() {
  vec4 world = model * vec4(inPosition, 1.0);
  position = world.xyz;
  // Of unit length before they are interpolated, so that scaling does not bend them.
  vec3 worldNormal = mat3(normalMatrix) * inNormal;
  normal = worldNormal * inversesqrt(max(dot(worldNormal, worldNormal), 1e-30));
  vec3 worldTangent = mat3(model) * inTangent.xyz;
  tangent = worldTangent * inversesqrt(max(dot(worldTangent, worldTangent), 1e-30));
  // A mirroring transform turns the handedness of the whole frame.
  handedness = determinant(mat3(model)) < 0.0 ? -inTangent.w : inTangent.w;
  texcoord = inTexcoord;
  texcoord1 = inTexcoord1;
  vertexColor = inColor;
  gl_Position = viewProjection * world;
}
