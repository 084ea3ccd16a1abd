// The metallic-roughness material of glTF 2.0 (appendix B) under point and directional lights and
// an environment; PBRMaterial.h has the formula.
#version 450 core
#include "lights.glsl"
#include "environment.glsl"
#include "tangent_frame.glsl"
#include "ggx.glsl"
#include "shown.glsl"

const float pi = 3.14159265358979;

// Where the texture of a unit lies.
struct Placement {
  vec4 matrix;  // 2 x 2, columns
  vec4 offset;  // xy; z: set of texture coordinates
};

layout(std140, binding = materialBinding) uniform PBR {
  vec4 baseColorFactor;  // linear
  vec4 emissionFactor;   // rgb: linear; w: alpha below which ALPHA_MASK draws nothing
  vec4 fresnel;          // of the dielectric: F0 before it is clamped; w: specular
  // Metallic, roughness, scale of the normal texture, strength of the occlusion.
  vec4 factors;
  // 2 x 2: the normal texture's directions in the mesh's tangent and bitangent.
  vec4 normalFrame;
  Placement placements[pbrUnitCount];
};

layout(binding = baseColorUnit) uniform sampler2D baseColorTexture;
layout(binding = metallicRoughnessUnit) uniform sampler2D metallicRoughnessTexture;
layout(binding = normalUnit) uniform sampler2D normalTexture;
layout(binding = emissionUnit) uniform sampler2D emissionTexture;
layout(binding = occlusionUnit) uniform sampler2D occlusionTexture;
layout(binding = specularUnit) uniform sampler2D specularTexture;
layout(binding = specularColorUnit) uniform sampler2D specularColorTexture;

in vec3 position;
in vec3 normal;
in vec3 tangent;
in vec2 texcoord;
in vec2 texcoord1;
in vec4 vertexColor;
flat in float handedness;

layout(location = 0) out vec4 color;

// What a surface is made of at one point.
struct Surface {
  vec3 base;
  float metallic;
  float roughness;
  float alpha;  // of GGX
  vec3 f0;      // of the dielectric
  float f90;
};

vec4 fetch(sampler2D image, int unit) {
  Placement placement = placements[unit];
  vec2 uv = placement.offset.z == 0.0 ? texcoord : texcoord1;
  return texture(image, mat2(placement.matrix) * uv + placement.offset.xy);
}

vec4 baseColor() {
  vec4 base = baseColorFactor * vertexColor;
#ifdef BASE_COLOR_TEXTURE
  base *= fetch(baseColorTexture, baseColorUnit);
#endif
  return base;
}

vec3 emission() {
  vec3 radiance = emissionFactor.rgb;
#ifdef EMISSION_TEXTURE
  radiance *= fetch(emissionTexture, emissionUnit).rgb;
#endif
  return radiance;
}

Surface surfaceOf(vec3 base) {
  float metallic = factors.x, roughness = factors.y;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  vec4 texel = fetch(metallicRoughnessTexture, metallicRoughnessUnit);
  metallic *= texel.b;
  roughness *= texel.g;
#endif
  roughness = max(roughness, 0.045);
  vec3 f0 = fresnel.rgb;
#ifdef SPECULAR_COLOR_TEXTURE
  f0 *= fetch(specularColorTexture, specularColorUnit).rgb;
#endif
  float specular = fresnel.w;
#ifdef SPECULAR_TEXTURE
  specular *= fetch(specularTexture, specularUnit).a;
#endif
  return Surface(base, metallic, roughness, roughness * roughness, specular * min(f0, vec3(1.0)),
                 specular);
}

// Unit; on a back face the whole mapped normal turns.
vec3 surfaceNormal() {
  TangentFrame frame = tangentFrame(normal, tangent, handedness, false);
  vec3 n = frame.n;
#ifdef NORMAL_TEXTURE
  vec3 mapped = 2.0 * fetch(normalTexture, normalUnit).xyz - 1.0;
  mapped.xy = mat2(normalFrame) * (factors.z * mapped.xy);
  n = mapped.x * frame.t + mapped.y * frame.b + mapped.z * frame.n;
  n *= inversesqrt(max(dot(n, n), 1e-12));
#endif
  return gl_FrontFacing ? n : -n;
}

// Unit vectors; nl > 0. Per steradian.
vec3 reflectance(Surface surface, vec3 n, vec3 v, vec3 l, float nl) {
  vec3 h = l + v;
  h *= inversesqrt(max(dot(h, h), 1e-12));
  float nv = max(abs(dot(n, v)), 1e-4);  // a normal texture may look away
  float specular = microfacets(surface.alpha, n, h, nl, nv);
  float weight = pow(1.0 - clamp(dot(v, h), 0.0, 1.0), 5.0);
  vec3 reflected = mix(surface.f0, vec3(surface.f90), weight);
  float entering = 1.0 - max(reflected.r, max(reflected.g, reflected.b));
  specular *= specularPart;
  vec3 dielectric = diffusePart * entering * surface.base / pi + reflected * specular;
  vec3 metal = mix(surface.base, vec3(1.0), weight) * specular;
  return mix(dielectric, metal, surface.metallic);
}

#ifdef ENVIRONMENT
// How much of the surroundings is seen.
float openness() {
#ifdef OCCLUSION_TEXTURE
  return mix(1.0, fetch(occlusionTexture, occlusionUnit).r, factors.w);
#else
  return 1.0;
#endif
}

// The split sum: what the microfacets reflect in all, times the average of what they mirror. The
// rest enters a dielectric.
vec3 fromEnvironment(Surface surface, vec3 n, vec3 v) {
  float nv = dot(n, v);
  vec2 shares = microfacetShares(clamp(abs(nv), 0.0, 1.0), surface.roughness);
  vec3 mirrored = specularPart * glossyAround(toEnvironment(2.0 * nv * n - v), surface.roughness);
  vec3 diffuse = diffusePart * diffuseAround(toEnvironment(n));
  vec3 reflected = surface.f0 * shares.x + surface.f90 * shares.y;
  float entering = 1.0 - max(reflected.r, max(reflected.g, reflected.b));
  vec3 dielectric = entering * surface.base * diffuse + reflected * mirrored;
  vec3 metal = (surface.base * shares.x + shares.y) * mirrored;
  return openness() * environmentIntensity.w * environmentIntensity.rgb *
         mix(dielectric, metal, surface.metallic);
}
#endif

vec3 lit(vec3 base) {
  Surface surface = surfaceOf(base);
  vec3 n = surfaceNormal(), v = toEye(position);
  vec3 radiance = vec3(0.0);
  for (int i = 0; i < lightCount; ++i) {
    vec3 l;
    vec3 irradiance = lightAt(i, position, normal, l);
    float nl = dot(n, l);
    if (nl > 0.0) radiance += irradiance * nl * reflectance(surface, n, v, l, nl);
  }
#ifdef ENVIRONMENT
  radiance += fromEnvironment(surface, n, v);
#endif
  return radiance;
}

#ifdef DEPTH_ONLY
// 1/8 to 7/8, as evenly spread over 2 x 2 pixels as four can be.
float dotThreshold() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) & 1;
  return 0.125 + 0.25 * float(((pixel.x ^ pixel.y) << 1) | pixel.y);
}
#endif

void main() {
  vec4 base = baseColor();
#ifdef ALPHA_MASK
  if (base.a < emissionFactor.w) discard;
#endif
#ifdef DEPTH_ONLY
#ifdef ALPHA_BLEND
  // Light passes in proportion: filtered, dots are an average.
  if (base.a <= dotThreshold()) discard;
#endif
  return;
#endif
#ifdef UNLIT
  color.rgb = base.rgb + emission();
#else
  color.rgb = lit(base.rgb) + emission();
#endif
#ifdef ALPHA_BLEND
  color.a = base.a;
#else
  color.a = 1.0;
#endif
  color = shown(color);
}
