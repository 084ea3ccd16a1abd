// KHR_materials_iridescence: what a thin film reflects in which light interferes, after Belcour and
// Barla 2017, with Schlick's reflection at both of its sides.
#ifdef IRIDESCENCE

layout(binding = iridescenceUnit) uniform sampler2D iridescenceTexture;
layout(binding = iridescenceThicknessUnit) uniform sampler2D iridescenceThicknessTexture;

struct Film {
  float share;
  float refractiveIndex;
  float thickness;  // nanometres
};

Film filmOf() {
  float share = iridescenceFactors.x, thickness = iridescenceFactors.w;
#ifdef IRIDESCENCE_TEXTURE
  share *= fetch(iridescenceTexture, iridescenceUnit).r;
#endif
#ifdef IRIDESCENCE_THICKNESS_TEXTURE
  thickness = mix(iridescenceFactors.z, thickness,
                  fetch(iridescenceThicknessTexture, iridescenceThicknessUnit).g);
#endif
  return Film(share, iridescenceFactors.y, thickness);
}

// What waves add that are late by so many nanometres and shifted by so many radians, in linear
// sRGB: the Fourier transforms of the CIE's curves, which are Gaussians, X a sum of two.
vec3 interference(float late, vec3 shift) {
  vec3 wave = vec3(0.010562, 0.0112802, 0.0138758) * late;
  vec3 xyz = vec3(0.84659, 1.00022, 1.00112) * cos(wave + shift) *
             exp(-vec3(1.70855e-7, 3.67331e-7, 2.61035e-7) * late * late);
  xyz.x += 0.15387 * cos(0.0140737 * late + shift.x) * exp(-1.78766e-7 * late * late);
  return mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
              0.0415560, 1.0572252) * xyz;
}

// At an angle to the microfacet, over a base of this F0, which is that in air.
vec3 reflectedByFilm(Film film, float cosine, vec3 f0) {
  float ratio = (film.refractiveIndex - 1.0) / (film.refractiveIndex + 1.0);
  float below = 1.0 - (1.0 - cosine * cosine) / (film.refractiveIndex * film.refractiveIndex);
  if (below < 0.0) return vec3(1.0);
  float cosineBelow = sqrt(below);
  float above = mix(ratio * ratio, 1.0, pow(1.0 - cosine, 5.0)), passing = 1.0 - above;
  vec3 root = sqrt(min(f0 + 1e-4, vec3(0.9999)));
  vec3 base = (1.0 + root) / (1.0 - root);
  vec3 baseRatio = (base - film.refractiveIndex) / (base + film.refractiveIndex);
  vec3 atBase = mix(baseRatio * baseRatio, vec3(1.0), pow(1.0 - cosineBelow, 5.0));
  // Half a wave where light is reflected by what is denser.
  vec3 shift = vec3(film.refractiveIndex < 1.0 ? 0.0 : pi);
  shift += mix(vec3(0.0), vec3(pi), lessThan(base, vec3(film.refractiveIndex)));
  vec3 twice = clamp(above * atBase, 1e-5, 0.9999), once = sqrt(twice);
  vec3 returned = passing * passing * atBase / (1.0 - twice);
  vec3 sum = above + returned, amplitude = returned - passing;
  float late = 2.0 * film.refractiveIndex * film.thickness * cosineBelow;
  for (float order = 1.0; order <= 2.0; ++order) {
    amplitude *= once;
    sum += 2.0 * amplitude * interference(order * late, order * shift);
  }
  return clamp(sum, 0.0, 1.0);
}

// What is reflected with the film.
vec3 throughFilm(Film film, float cosine, vec3 f0, vec3 reflected) {
  return mix(reflected, reflectedByFilm(film, clamp(cosine, 0.0, 1.0), f0), film.share);
}
#endif
