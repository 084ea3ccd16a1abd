// The model `loom`: LoomModel.h has the formula.
#include "light_maps.glsl"

#ifdef GLOSS
#include "gloss.glsl"
const int firstWeights = 1;  // behind the lobe's numbers
#else
const int firstWeights = 0;
#endif

// a square a view, side by side
layout(binding = TABLE_light_maps) uniform sampler2DArray lightMaps;
// a texel a view: its deviation, and the height (Registration.h)
layout(binding = TABLE_registration) uniform sampler2DArray registration;

// Towards the view from a surface at height 1 (FieldFormula::shift()).
vec2 tangentOf(vec3 view) {
  return view.xy / max(view.z, 1e-3);
}

// How much of a shift may be made. On bent surfaces it changes from place to place, and where it
// changes by more than the place does, the texture would run backwards: half of that is allowed. On
// a sphere what is left grows steadily up to the silhouette.
float shareOfShift(Place place, vec2 shift) {
  vec2 size = vec2(surfaceSize());
  mat2 places = mat2(place.toRight * size, place.upwards * size);
  mat2 shifts = mat2(dFdx(shift), dFdy(shift));
  float area = abs(determinant(places));
  // The cofactors of `places`, so that nothing is divided by an area of 0.
  mat2 change = shifts * mat2(places[1][1], -places[0][1], -places[1][0], places[0][0]);
  float largest = sqrt(dot(change[0], change[0]) + dot(change[1], change[1]));
  return 2.0 * largest > area ? area / (2.0 * largest) : 1.0;
}

Place seenAt(Place place, LayerWeights layers, vec3 view) {
  float height = texelFetch(registration, ivec3(0), 0).b;
  vec2 shift = height * tangentOf(notBelow(view, lowestViewZ));
  for (int k = 0; k < 3; ++k)
    if (layers.weight[k] > 0.0)
      shift += layers.weight[k] * texelFetch(registration, ivec3(layers.index[k], 0, 0), 0).rg;
  shift *= shareOfShift(place, height * tangentOf(view));
  place.texcoord += vec2(shift.x, -shift.y) / vec2(surfaceSize());
  return place;
}

// The place of a light in a view's map.
vec2 lightMapPlace(vec3 light, int view) {
  vec2 size = vec2(textureSize(lightMaps, 0).xy);
  return (lightMapTexel(light, size.y) + vec2(float(view) * size.y, 0.0)) / size;
}

// What hue adds to a colour whose luminance stays.
vec3 hueOf(float red, float blue) {
  return vec3(red, -(0.2126 * red + 0.0722 * blue) / 0.7152, blue);
}

// As it was fitted, without n.l.
vec3 evaluateColor(Texel texel, Layer layer, vec3 light, vec3 view) {
  vec2 place = lightMapPlace(light, layer.index);
  float y = 0.0;
  int i = 0;
  do {
    y += dot(texel.weights[firstWeights + i], textureLod(lightMaps, vec3(place, i), 0.0));
  } while (++i < texel.count - firstWeights);
  vec4 hue = textureLod(lightMaps, vec3(place, COMPONENTS / 4), 0.0);
  vec2 first = texel.weights[firstWeights].xy;
  vec3 color = diffusePart * (y * texel.baseColor + hueOf(dot(first, hue.xy), dot(first, hue.zw)));
#ifdef GLOSS
  color += specularPart * glossValue(glossLobe(texel.weights[0]), light, view);
#endif
  // What components reflect is not told apart: it counts as diffuse.
  return max(color, 0.0);
}

#ifdef ENVIRONMENT
// a row a view; along it the terms of LoomModel::kTerms
layout(binding = TABLE_light_polynomials) uniform sampler2DArray lightPolynomials;

void prepareEnvironment(inout EnvironmentFrame frame) {
  fetchMoments(frame);
}

vec3 colorUnderEnvironment(Texel texel, Layer layer, vec3 view, EnvironmentFrame frame) {
  vec3 color = vec3(0.0);
  for (int term = 0; term < 6; ++term) {
    int count = texel.count - firstWeights;
    if (term < 3) count = min(QUADRATIC / 4, count);
    float y = 0.0;
    int i = 0;
    do {
      y += dot(texel.weights[firstWeights + i],
               polynomialTexel(lightPolynomials, term, layer.index, i));
    } while (++i < count);
    vec4 hue = polynomialTexel(lightPolynomials, term, layer.index, COMPONENTS / 4);
    vec2 first = texel.weights[firstWeights].xy;
    color += (y * texel.baseColor + hueOf(dot(first, hue.xy), dot(first, hue.zw))) *
             frame.moments[term];
  }
  color *= diffusePart;
#ifdef GLOSS
  color += specularPart * glossUnderEnvironment(glossLobe(texel.weights[0]), view, frame);
#endif
  return max(color, 0.0);
}
#endif
