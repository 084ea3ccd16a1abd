// Vertex stage of every material: world-space position and tangent frame.
#version 450 core
#include "lights.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec2 inTexcoord;
layout(location = 4) in vec2 inTexcoord1;
layout(location = 5) in vec4 inColor;
// Rows of the matrix to world space, the same for all vertices of an instance (scenegraph/src/FlatScene.h: ModelRows).
layout(location = 13) in vec4 modelRow0;
layout(location = 14) in vec4 modelRow1;
layout(location = 15) in vec4 modelRow2;

out vec3 position;
out vec3 normal;
out vec3 tangent;
out vec2 texcoord;
out vec2 texcoord1;
out vec4 vertexColor;  // linear
flat out float handedness;  // +1 or -1: of the bitangent, which points up the image

void main() {
  vec4 local = vec4(inPosition, 1.0);
  position = vec3(dot(modelRow0, local), dot(modelRow1, local), dot(modelRow2, local));
  // The rows of the inverse transpose, but for the factor det(model).
  vec3 cofactor0 = cross(modelRow1.xyz, modelRow2.xyz);
  vec3 cofactor1 = cross(modelRow2.xyz, modelRow0.xyz);
  vec3 cofactor2 = cross(modelRow0.xyz, modelRow1.xyz);
  float mirror = dot(modelRow0.xyz, cofactor0) < 0.0 ? -1.0 : 1.0;
  // Of unit length before they are interpolated, so that scaling does not bend them.
  vec3 worldNormal = mirror * vec3(dot(cofactor0, inNormal), dot(cofactor1, inNormal), dot(cofactor2, inNormal));
  normal = worldNormal * inversesqrt(max(dot(worldNormal, worldNormal), 1e-30));
  vec3 worldTangent =
      vec3(dot(modelRow0.xyz, inTangent.xyz), dot(modelRow1.xyz, inTangent.xyz), dot(modelRow2.xyz, inTangent.xyz));
  tangent = worldTangent * inversesqrt(max(dot(worldTangent, worldTangent), 1e-30));
  // A mirroring transform turns the handedness of the whole frame.
  handedness = mirror * inTangent.w;
  texcoord = inTexcoord;
  texcoord1 = inTexcoord1;
  vertexColor = inColor;
  gl_Position = viewProjection * vec4(position, 1.0);
}
