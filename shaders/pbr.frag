// The metallic-roughness material of glTF 2.0 (appendix B) under point and directional lights and
// an environment, with the layers of Khronos' extensions that a material has; PBRMaterial.h has the
// formula.
#version 450 core
#include "lights.glsl"
#include "environment.glsl"
#include "tangent_frame.glsl"
#include "ggx.glsl"
#include "shown.glsl"

const float pi = 3.14159265358979;
const float smoothest = 0.045;  // roughness, so that highlights stay finite

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
  vec4 clearcoatFactors;  // factor, roughness, scale of its normal texture
  vec4 clearcoatFrame;    // as normalFrame
  vec4 sheenFactors;      // rgb: linear; w: roughness
  vec4 anisotropyFrame;   // 2 x 2: from its texture to the mesh's tangent and bitangent
  vec4 iridescenceFactors;  // factor, refractive index, least and greatest thickness
  vec4 layerFactors;        // strength of the anisotropy, share of the transmission
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

vec4 fetch(sampler2D image, int unit) {
  Placement placement = placements[unit];
  vec2 uv = placement.offset.z == 0.0 ? texcoord : texcoord1;
  return texture(image, mat2(placement.matrix) * uv + placement.offset.xy);
}

// Of length 0 where they are opposite.
vec3 halfway(vec3 v, vec3 l) {
  vec3 h = l + v;
  return h * inversesqrt(max(dot(h, h), 1e-12));
}

// Unit.
vec3 mappedNormal(TangentFrame frame, vec3 texel, vec4 textureFrame, float scale) {
  vec3 mapped = 2.0 * texel - 1.0;
  mapped.xy = mat2(textureFrame) * (scale * mapped.xy);
  vec3 n = mapped.x * frame.t + mapped.y * frame.b + mapped.z * frame.n;
  return n * inversesqrt(max(dot(n, n), 1e-12));
}

#include "clearcoat.glsl"
#include "sheen.glsl"
#include "anisotropy.glsl"
#include "iridescence.glsl"
#include "transmission.glsl"

// What a surface is made of at one point.
struct Surface {
  vec3 n;
  vec3 base;
  float metallic;
  float roughness;
  float alpha;  // of GGX
  vec3 f0;      // of the dielectric
  float f90;
  float diffuse;  // of what enters it, the share that comes back
#ifdef ANISOTROPY
  Grooves grooves;
#endif
#ifdef IRIDESCENCE
  Film film;
#endif
#ifdef SHEEN
  SheenLayer sheen;
#endif
#ifdef CLEARCOAT
  Coat coat;
#endif
};

vec4 baseColor() {
  vec4 base = baseColorFactor * vertexColor;
#ifdef BASE_COLOR_TEXTURE
  base *= fetch(baseColorTexture, baseColorUnit);
#endif
  return base;
}

vec3 emission() {
#ifdef SHOW_ALBEDO
  return vec3(0.0);
#endif
  vec3 radiance = emissionFactor.rgb;
#ifdef EMISSION_TEXTURE
  radiance *= fetch(emissionTexture, emissionUnit).rgb;
#endif
  return radiance;
}

void readMetalAndRoughness(inout Surface surface) {
  float metallic = factors.x, roughness = factors.y;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  vec4 texel = fetch(metallicRoughnessTexture, metallicRoughnessUnit);
  metallic *= texel.b;
  roughness *= texel.g;
#endif
  surface.metallic = metallic;
  surface.roughness = max(roughness, smoothest);
  surface.alpha = surface.roughness * surface.roughness;
}

void readSpecular(inout Surface surface) {
  vec3 f0 = fresnel.rgb;
#ifdef SPECULAR_COLOR_TEXTURE
  f0 *= fetch(specularColorTexture, specularColorUnit).rgb;
#endif
  surface.f90 = fresnel.w;
#ifdef SPECULAR_TEXTURE
  surface.f90 *= fetch(specularTexture, specularUnit).a;
#endif
  surface.f0 = surface.f90 * min(f0, vec3(1.0));
}

// On a back face the whole mapped normal turns.
vec3 surfaceNormal(TangentFrame frame) {
  vec3 n = frame.n;
#ifdef NORMAL_TEXTURE
  n = mappedNormal(frame, fetch(normalTexture, normalUnit).xyz, normalFrame, factors.z);
#endif
  return gl_FrontFacing ? n : -n;
}

Surface surfaceOf(vec3 base, vec3 v) {
  TangentFrame frame = tangentFrame(normal, tangent, handedness, false);
  Surface surface;
  surface.n = surfaceNormal(frame);
  surface.base = base;
  surface.diffuse = 1.0;
  readMetalAndRoughness(surface);
  readSpecular(surface);
#ifdef TRANSMISSION
  surface.diffuse -= transmission();
#endif
#ifdef ANISOTROPY
  surface.grooves = groovesOf(frame, surface.n, surface.alpha);
#endif
#ifdef IRIDESCENCE
  surface.film = filmOf();
#endif
#ifdef SHEEN
  surface.sheen = sheenOf(surface.n, v);
#endif
#ifdef CLEARCOAT
  surface.coat = coatOf(frame, v);
#endif
  return surface;
}

float strongest(vec3 reflected) {
  return max(reflected.r, max(reflected.g, reflected.b));
}

// What is reflected at a cosine to the microfacets, by the dielectric and by the metal.
void reflectedAt(Surface surface, float cosine, out vec3 dielectric, out vec3 metal) {
  float weight = pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0);
  dielectric = mix(surface.f0, vec3(surface.f90), weight);
  metal = mix(surface.base, vec3(1.0), weight);
#ifdef IRIDESCENCE
  dielectric = throughFilm(surface.film, cosine, surface.f0, dielectric);
  metal = throughFilm(surface.film, cosine, surface.base, metal);
#endif
}

// Unit vectors; nl > 0. Per steradian.
vec3 reflectance(Surface surface, vec3 v, vec3 l, float nl) {
  vec3 h = halfway(v, l);
#ifdef ANISOTROPY
  float specular = microfacetsOfGrooves(surface.grooves, v, l);
#else
  float nv = max(abs(dot(surface.n, v)), 1e-4);  // a normal texture may look away
  float specular = microfacets(surface.alpha, surface.n, h, nl, nv);
#endif
  vec3 byDielectric, byMetal;
  reflectedAt(surface, dot(v, h), byDielectric, byMetal);
  float entering = surface.diffuse * (1.0 - strongest(byDielectric));
  specular *= specularPart;
  vec3 dielectric = diffusePart * entering * surface.base / pi + byDielectric * specular;
  return mix(dielectric, byMetal * specular, surface.metallic);
}

// What shows of a light whose irradiance, on what faces it, is 1.
vec3 shownOf(Surface surface, vec3 v, vec3 l) {
  float nl = dot(surface.n, l);
  vec3 radiance = nl > 0.0 ? nl * reflectance(surface, v, l, nl) : vec3(0.0);
#ifdef SHEEN
  radiance = belowSheen(surface.sheen, radiance, surface.n, v, l);
#endif
#ifdef CLEARCOAT
  radiance = belowCoat(surface.coat, radiance, v, l);
#endif
  return radiance;
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

// What microfacets mirror, and how much of it those of F0 and of F90 reflect in all.
vec3 mirroredAround(Surface surface, vec3 v, float nv, out vec2 shares) {
  float cosine = clamp(abs(nv), 0.0, 1.0);
#ifdef ANISOTROPY
  // as rough as both directions on average
  float alpha = sqrt(surface.grooves.alpha.x * surface.grooves.alpha.y);
  shares = microfacetShares(cosine, sqrt(alpha));
  return mirroredByGrooves(surface.grooves, v, surface.roughness);
#else
  shares = microfacetShares(cosine, surface.roughness);
  return glossyAround(toEnvironment(2.0 * nv * surface.n - v), surface.roughness);
#endif
}

// The split sum: what the microfacets reflect in all, times the average of what they mirror. The
// rest enters a dielectric.
vec3 fromEnvironment(Surface surface, vec3 v) {
  float nv = dot(surface.n, v);
  vec2 shares;
  vec3 mirrored = specularPart * mirroredAround(surface, v, nv, shares);
  vec3 diffuse = diffuseAround(toEnvironment(surface.n));
  vec3 byDielectric = surface.f0 * shares.x + surface.f90 * shares.y;
  vec3 byMetal = surface.base * shares.x + shares.y;
#ifdef IRIDESCENCE
  // As all microfacets reflect that lie flat.
  vec3 white = vec3(shares.x + shares.y);
  byDielectric = throughFilm(surface.film, abs(nv), surface.f0, byDielectric / white) * white;
  byMetal = throughFilm(surface.film, abs(nv), surface.base, byMetal / white) * white;
#endif
  float entering = surface.diffuse * (1.0 - strongest(byDielectric));
  vec3 dielectric = diffusePart * entering * surface.base * diffuse + byDielectric * mirrored;
  vec3 radiance = mix(dielectric, byMetal * mirrored, surface.metallic);
#ifdef SHEEN
  radiance = leftBelowSheen(surface.sheen, surface.sheen.share) * radiance +
             specularPart * surface.sheen.share * surface.sheen.color * diffuse;
#endif
#ifdef CLEARCOAT
  radiance = belowCoatInEnvironment(surface.coat, radiance, v);
#endif
  return openness() * environmentIntensity.w * environmentIntensity.rgb * radiance;
}
#endif

#ifdef TRANSMISSION
// What passes the surface and all that lies on it.
vec3 passingShare(Surface surface, vec3 v) {
  vec3 byDielectric, byMetal;
  reflectedAt(surface, abs(dot(surface.n, v)), byDielectric, byMetal);
  float share = (1.0 - surface.diffuse) * (1.0 - surface.metallic);
  share *= 1.0 - strongest(byDielectric);
#ifdef SHEEN
  share *= leftBelowSheen(surface.sheen, surface.sheen.share);
#endif
#ifdef CLEARCOAT
  share *= 1.0 - surface.coat.share;
#endif
  return share * surface.base;
}
#endif

vec3 lit(vec3 base) {
  vec3 v = toEye(position);
  Surface surface = surfaceOf(base, v);
  vec3 radiance = vec3(0.0);
  for (int i = 0; i < lightCount; ++i) {
    vec3 l;
#ifdef SHOW_ALBEDO
    vec3 irradiance = lightAt(i, position, surface.n, l);
#else
    vec3 irradiance = lightAt(i, position, normal, l);
#endif
    radiance += irradiance * shownOf(surface, v, l);
  }
#ifdef ENVIRONMENT
  radiance += fromEnvironment(surface, v);
#endif
  vec3 glow = emission();
#ifdef CLEARCOAT
  glow *= 1.0 - surface.coat.share;
#endif
#ifdef TRANSMISSION
  passing = vec4(passingShare(surface, v), 1.0);
#endif
  return radiance + glow;
}

#ifdef DEPTH_ONLY
// 1/8 to 7/8, as evenly spread over 2 x 2 pixels as four can be.
float dotThreshold() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) & 1;
  return 0.125 + 0.25 * float(((pixel.x ^ pixel.y) << 1) | pixel.y);
}

// How much light a surface keeps off.
float opacity(vec4 base) {
#ifdef TRANSMISSION
  Surface surface;
  readMetalAndRoughness(surface);
  float share = transmission() * (1.0 - surface.metallic);
  return base.a * (1.0 - share * dot(base.rgb, vec3(1.0 / 3.0)));
#else
  return base.a;
#endif
}
#endif

// What a surface covers a share of the pixel with.
void cover(float alpha) {
#ifdef TRANSMISSION
  color.rgb *= alpha;
  passing.rgb = mix(vec3(1.0), passing.rgb, alpha);
  passing = shown(passing);
  passing.a = dot(passing.rgb, vec3(1.0 / 3.0));
  color.a = 1.0 - passing.a;
#else
  color.a = alpha;
#endif
}

void main() {
  vec4 base = baseColor();
#ifdef ALPHA_MASK
  if (base.a < emissionFactor.w) discard;
#endif
#ifdef DEPTH_ONLY
#if defined(ALPHA_BLEND) || defined(TRANSMISSION)
  // Light passes in proportion: filtered, dots are an average.
  if (opacity(base) <= dotThreshold()) discard;
#endif
  return;
#endif
#ifdef UNLIT
  color.rgb = base.rgb + emission();
#else
  color.rgb = lit(base.rgb);
#endif
#ifdef ALPHA_BLEND
  cover(base.a);
#else
  cover(1.0);
#endif
#ifdef SHOW_NORMAL
  vec3 n = surfaceNormal(tangentFrame(normal, tangent, handedness, false));
#else
  vec3 n = normal;
#endif
  color = shownSurface(color, position, n, texcoord);
#ifdef TRANSMISSION
  if (!showsLight) passing = vec4(0.0);
#endif
}
