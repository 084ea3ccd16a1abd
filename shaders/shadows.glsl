// What opaque things leave of a light: maps of the depths that the light sees
// (scenegraph/src/ShadowMaps.h).
#ifdef SHADOW_MAPS
layout(binding = shadowMapsUnit) uniform sampler2DArrayShadow shadowMaps;

// A tent over 3 x 3 texels, by four lookups that the hardware filters over 2 x 2 each.
float litShareIn(float layer, vec3 place) {
  float size = float(textureSize(shadowMaps, 0).x);
  vec2 texel = place.xy * size;
  vec2 corner = floor(texel + 0.5);
  vec2 beyond = texel + 0.5 - corner;
  // The weights of the lower and the higher pair of texels along each axis, and where the lookup
  // stands that weighs the texels of a pair as the tent does.
  vec2 low = 3.0 - 2.0 * beyond, high = 1.0 + 2.0 * beyond;
  vec2 atLow = (corner - 1.5 + (2.0 - beyond) / low) / size;
  vec2 atHigh = (corner + 0.5 + beyond / high) / size;
  return (low.x * low.y * texture(shadowMaps, vec4(atLow, layer, place.z)) +
          high.x * low.y * texture(shadowMaps, vec4(atHigh.x, atLow.y, layer, place.z)) +
          low.x * high.y * texture(shadowMaps, vec4(atLow.x, atHigh.y, layer, place.z)) +
          high.x * high.y * texture(shadowMaps, vec4(atHigh, layer, place.z))) / 16.0;
}
#endif

#ifdef SHADOW_CUBES
layout(binding = shadowCubesUnit) uniform samplerCubeArrayShadow shadowCubes;

// The same, around a direction from the lamp: four lookups half a texel to the sides of it.
float litShareAround(vec4 shadow, vec3 fromLamp, float texel) {
  vec3 aside = abs(fromLamp.x) < abs(fromLamp.y) ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 x = normalize(cross(aside, fromLamp)), y = normalize(cross(fromLamp, x));
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 side = vec2(i & 1, i >> 1) - 0.5;
    vec3 d = fromLamp + texel * (side.x * x + side.y * y);
    vec3 sizes = abs(d);
    float depth = shadow.z - shadow.w / max(sizes.x, max(sizes.y, sizes.z));
    sum += texture(shadowCubes, vec4(d, shadow.x), depth);
  }
  return 0.25 * sum;
}
#endif

// How much of a light arrives at a point. `away`: the distance of a lamp, 1 of parallel light.
float litShare(int index, vec3 point, vec3 normal, vec3 toLight, float away) {
#if defined(SHADOW_MAPS) || defined(SHADOW_CUBES)
  vec4 shadow = lights[index].shadow;
  if (shadow.x < 0.0) return 1.0;
  // Over the filter's width a surface gets nearer to the light, by more the more it leans. So the
  // lookup stands off the surface, on the lit side, by that width times the sine of the lean.
  vec3 unit = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  float facing = dot(unit, toLight);
  float texel = shadow.y * away;
  float lean = sqrt(max(1.0 - facing * facing, 0.0));
  vec3 off = point + (facing < 0.0 ? -1.0 : 1.0) * texel * (2.5 * lean + 0.1) * unit;
#ifdef SHADOW_CUBES
  if (shadow.w > 0.0) return litShareAround(shadow, off - lights[index].place.xyz, texel);
#endif
#ifdef SHADOW_MAPS
  vec4 place = shadowMatrices[int(shadow.x)] * vec4(off, 1.0);
  return litShareIn(shadow.x, place.xyz / place.w);
#endif
#endif
  return 1.0;
}
