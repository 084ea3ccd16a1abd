// The model `lod`: LodModel.h has the formula.
#include "light_maps.glsl"

// a square a view, side by side, and a row of these a level
layout(binding = TABLE_eigen_brdfs) uniform sampler2DArray eigenBrdfs;
// ka, kd, ks, exponent; Cb, Cr
layout(binding = TABLE_mean) uniform sampler2DArray meanNumbers;

// Y, Cb, Cr of what all texels have in common.
vec3 meanOf(vec3 light, vec3 view) {
  vec4 phong = texelFetch(meanNumbers, ivec3(0), 0);
  float highlight = pow(max(normalize(light + view).z, 1e-6), phong.w);
  return vec3(phong.x + phong.y * light.z + phong.z * highlight,
              texelFetch(meanNumbers, ivec3(0, 0, 1), 0).xy);
}

// Adds what four components give to Y, Cb and Cr: a multiple of four are Y's, an even number Cb's.
void addProducts(inout vec3 sum, vec4 products, int fourth) {
  int ofChroma = 4 * fourth - COMPONENTS;
  if (ofChroma < 0) {
    sum.x += dot(products, vec4(1.0));
  } else {
    sum[ofChroma < CHROMA ? 1 : 2] += products.x + products.y;
    sum[ofChroma + 2 < CHROMA ? 1 : 2] += products.z + products.w;
  }
}

vec3 rgbOf(vec3 yCbCr) {
  float r = yCbCr.x + 1.402 * yCbCr.z, b = yCbCr.x + 1.772 * yCbCr.y;
  return vec3(r, (yCbCr.x - 0.299 * r - 0.114 * b) / 0.587, b);
}

// As it was fitted, with or without n.l.
vec3 evaluateColor(Texel texel, Layer layer, vec3 light, vec3 view) {
  vec2 size = vec2(textureSize(eigenBrdfs, 0).xy);
  float side = size.y / float(LEVELS);
  // in the finest level's map
  vec2 first = lightMapTexel(light, side) + vec2(float(layer.index) * side, 0.0);
  vec3 sum = meanOf(light, view);
  int level = texel.first;
  do {
    vec2 place = (first + vec2(0.0, side * float(level))) / size;
    for (int i = 0; i < SHARED_TEXELS; ++i)
      addProducts(sum, texel.weights[level * SHARED_TEXELS + i] *
                           textureLod(eigenBrdfs, vec3(place, i), 0.0), i);
  } while (++level < LEVELS);
  // What components reflect is not told apart: it counts as diffuse.
  return diffusePart * max(rgbOf(sum), 0.0);
}

#ifdef ENVIRONMENT
// a row a view, and as many of these as levels; along it the terms of LodModel::kTerms
layout(binding = TABLE_light_polynomials) uniform sampler2DArray lightPolynomials;
// of the mean
layout(binding = TABLE_mean_polynomials) uniform sampler2DArray meanPolynomials;

void prepareEnvironment(inout EnvironmentFrame frame) {
  fetchMoments(frame);
}

vec3 colorUnderEnvironment(Texel texel, Layer layer, vec3 view, EnvironmentFrame frame) {
  int views = textureSize(meanPolynomials, 0).y;
  vec2 chroma = texelFetch(meanNumbers, ivec3(0, 0, 1), 0).xy;
  vec3 color = vec3(0.0);
  for (int term = 0; term < 6; ++term) {
    // Y, Cb, Cr; the last term is 1
    vec3 factors = vec3(polynomialTexel(meanPolynomials, term, layer.index, 0).x,
                        term == 5 ? chroma : vec2(0.0));
    int level = texel.first;
    do {
      int row = level * views + layer.index;
      for (int i = 0; i < SHARED_TEXELS; ++i)
        addProducts(factors, texel.weights[level * SHARED_TEXELS + i] *
                                 polynomialTexel(lightPolynomials, term, row, i), i);
    } while (++level < LEVELS);
    color += rgbOf(factors) * frame.moments[term];
  }
  return diffusePart * max(color, 0.0);
}
#endif
