// Vertex stage of every material: position around the eye and tangent frame, both along the world's
// axes.
#version 450 core
#include "lights.glsl"

layout(location = 0) in vec3 inPosition;  // from the middle of the mesh's bounds
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec2 inTexcoord;
layout(location = 4) in vec2 inTexcoord1;
layout(location = 5) in vec4 inColor;
// Rows of the matrix to the eye, the same for all vertices of an instance
// (scenegraph/src/FlatScene.h: ModelRows).
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

// Before it is interpolated, so that scaling does not bend what is between.
vec3 unit(vec3 v) {
  return v * inversesqrt(max(dot(v, v), 1e-30));
}

void main() {
  vec4 local = vec4(inPosition, 1.0);
  position = vec3(dot(modelRow0, local), dot(modelRow1, local), dot(modelRow2, local));
  // Directions do not depend on a model's size, whose cube may be no float.
  vec3 sizes = abs(modelRow0.xyz) + abs(modelRow1.xyz) + abs(modelRow2.xyz);
  float scale = 1.0 / max(max(sizes.x, sizes.y), max(sizes.z, 1e-37));
  vec3 row0 = scale * modelRow0.xyz, row1 = scale * modelRow1.xyz, row2 = scale * modelRow2.xyz;
  // The rows of the inverse transpose, but for the factor det(model).
  vec3 cofactor0 = cross(row1, row2), cofactor1 = cross(row2, row0), cofactor2 = cross(row0, row1);
  float mirror = dot(row0, cofactor0) < 0.0 ? -1.0 : 1.0;
  normal = mirror * unit(vec3(dot(cofactor0, inNormal), dot(cofactor1, inNormal),
                              dot(cofactor2, inNormal)));
  tangent = unit(vec3(dot(row0, inTangent.xyz), dot(row1, inTangent.xyz),
                      dot(row2, inTangent.xyz)));
  // A mirroring transform turns the handedness of the whole frame.
  handedness = mirror * inTangent.w;
  texcoord = inTexcoord;
  texcoord1 = inTexcoord1;
  vertexColor = inColor;
  gl_Position = viewProjection * vec4(position, 1.0);
}
