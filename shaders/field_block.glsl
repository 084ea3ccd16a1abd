// What is the same for all texels of a reflectance field (FieldTextures.h, FieldBlock).
#include "bindings.glsl"

layout(std140, binding = materialBinding) uniform ReflectanceField {
  vec2 textureScale;         // repetitions per unit of texture coordinates
  float lowestLightZ;        // of the measured lights; where a field that contains n.l ends
  float lowestViewZ;         // of the measured views; models see no lower ones
  vec3 tint;                 // what the result is multiplied by
  float quadratureExponent;  // of lobes as wide as the measured lights are apart
  ivec4 weightsOfLevels[4];  // filtered_texel.glsl: fours of them, that are not all 0, by level
};

// The direction, or the one on the ring at height z below which it lies (field_value.glsl).
vec3 notBelow(vec3 direction, float z);

// The direction that varies within a layer: each *shade* stage defines it.
vec3 variedDirection(vec3 light, vec3 view);

// What a fit of stored values is read through, where DECODE names one of these (core/Color.h).
vec3 decodeGamma22(vec3 stored) { return pow(max(stored, 0.0), vec3(2.2)); }

vec3 decodeSrgb(vec3 stored) {
  stored = max(stored, 0.0);
  return mix(pow((stored + 0.055) / 1.055, vec3(2.4)), stored / 12.92,
             lessThanEqual(stored, vec3(0.04045)));
}
