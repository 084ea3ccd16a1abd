#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "weft/materials/PBROptions.h"
#include "weft/reflectance/SheenTable.h"

/// The formulas of glTF 2.0 (appendix B) and of Khronos' extensions of materials, as they are
/// printed there, in double precision: what pbr.frag is compared with. In the tangent frame of the
/// surface, without textures.
namespace weft::test {

inline double heaviside(double x) {
  return x > 0.0 ? 1.0 : 0.0;
}

inline double squareOf(double x) {
  return x * x;
}

inline double schlick(double f0, double cosine) {
  return f0 + (1.0 - f0) * std::pow(1.0 - std::abs(cosine), 5.0);
}

inline double maximumOf(glm::dvec3 color) {
  return std::max({color.x, color.y, color.z});
}

/// D V of microfacets around n.
inline double microfacetsOf(double alpha, glm::dvec3 n, glm::dvec3 v, glm::dvec3 l) {
  const glm::dvec3 h = glm::normalize(l + v);
  const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h);
  const auto root = [&](double x) { return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * x * x); };
  const double shadowing =
      2.0 * nl * nv * heaviside(glm::dot(h, l)) * heaviside(glm::dot(h, v)) / (nl * root(nv) + nv * root(nl));
  const double distribution =
      alpha * alpha * heaviside(nh) / (glm::pi<double>() * squareOf(nh * nh * (alpha * alpha - 1.0) + 1.0));
  return shadowing * distribution / (4.0 * nl * nv);
}

/// KHR_materials_anisotropy: of two alphas, along x (turned by `rotation`) and across.
inline double anisotropicMicrofacets(double alphaT, double alphaB, double rotation, glm::dvec3 v,
                                     glm::dvec3 l) {
  const glm::dvec3 t(std::cos(rotation), std::sin(rotation), 0), b(-t.y, t.x, 0), h = glm::normalize(l + v);
  const double width = squareOf(glm::dot(h, t) / alphaT) + squareOf(glm::dot(h, b) / alphaB) + squareOf(h.z);
  const double distribution = 1.0 / (glm::pi<double>() * alphaT * alphaB * width * width);
  const auto length = [&](glm::dvec3 d) {
    return glm::length(glm::dvec3(alphaT * glm::dot(t, d), alphaB * glm::dot(b, d), d.z));
  };
  return distribution * 0.5 / (l.z * length(v) + v.z * length(l));
}

/// KHR_materials_iridescence: evalSensitivity().
inline glm::dvec3 filmSensitivity(double opd, glm::dvec3 shift) {
  const double pi = glm::pi<double>(), phase = 2.0 * pi * opd * 1.0e-9;
  const glm::dvec3 val(5.4856e-13, 4.4201e-13, 5.2481e-13), pos(1.6810e+06, 1.7953e+06, 2.2084e+06),
      var(4.3278e+09, 9.3046e+09, 6.6121e+09);
  glm::dvec3 xyz;
  for (int i = 0; i < 3; ++i)
    xyz[i] = val[i] * std::sqrt(2.0 * pi * var[i]) * std::cos(pos[i] * phase + shift[i]) *
             std::exp(-phase * phase * var[i]);
  xyz.x += 9.7470e-14 * std::sqrt(2.0 * pi * 4.5282e+09) * std::cos(2.2399e+06 * phase + shift[0]) *
           std::exp(-4.5282e+09 * phase * phase);
  return glm::dmat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
                    0.0415560, 1.0572252) *
         xyz / 1.0685e-7;
}

/// KHR_materials_iridescence: iridescent_fresnel(), at most 1.
inline glm::dvec3 filmFresnel(const Iridescence& film, double cosine, glm::dvec3 baseF0) {
  const double ior = film.refractiveIndex, pi = glm::pi<double>();
  const double below = 1.0 - (1.0 - cosine * cosine) / (ior * ior);
  if (below < 0.0) return glm::dvec3(1.0);
  const double cosine2 = std::sqrt(below);
  const double r12 = schlick(squareOf((ior - 1.0) / (ior + 1.0)), cosine), t121 = 1.0 - r12;
  glm::dvec3 r23, phi;
  for (int i = 0; i < 3; ++i) {
    const double root = std::sqrt(std::min(baseF0[i] + 0.0001, 0.9999));
    const double baseIor = (1.0 + root) / (1.0 - root);
    r23[i] = schlick(squareOf((baseIor - ior) / (baseIor + ior)), cosine2);
    phi[i] = (ior < 1.0 ? 0.0 : pi) + (baseIor < ior ? pi : 0.0);
  }
  const double opd = 2.0 * ior * film.maximumThickness * cosine2;
  const glm::dvec3 r123 = glm::clamp(r12 * r23, 1e-5, 0.9999);
  const glm::dvec3 rs = t121 * t121 * r23 / (1.0 - r123);
  glm::dvec3 sum = r12 + rs, cm = rs - t121;
  for (int m = 1; m <= 2; ++m) {
    cm *= glm::sqrt(r123);
    sum += cm * 2.0 * filmSensitivity(m * opd, double(m) * phi);
  }
  return glm::clamp(sum, 0.0, 1.0);
}

/// What dielectric and metal reflect at a cosine to the microfacets.
struct FresnelPair {
  glm::dvec3 dielectric, metal;
};

inline FresnelPair fresnelOf(const PBROptions& material, double cosine) {
  const glm::dvec3 base(material.baseColor);
  const double weight = std::pow(1.0 - std::abs(cosine), 5.0), specular = material.specular;
  const double ratio = squareOf((material.refractiveIndex - 1.0) / (material.refractiveIndex + 1.0));
  const glm::dvec3 f0 = glm::min(ratio * glm::dvec3(material.specularColor), glm::dvec3(1.0)) * specular;
  FresnelPair pair{f0 + (specular - f0) * weight, base + (1.0 - base) * weight};
  const Iridescence& film = material.iridescence;
  if (film.factor > 0.0f) {
    pair.dielectric = glm::mix(pair.dielectric, filmFresnel(film, cosine, f0), double{film.factor});
    pair.metal = glm::mix(pair.metal, filmFresnel(film, cosine, base), double{film.factor});
  }
  return pair;
}

/// Per steradian, without sheen and coat.
inline glm::dvec3 baseReflectance(const PBROptions& material, glm::dvec3 v, glm::dvec3 l) {
  const double alpha = squareOf(material.roughness), strength = material.anisotropy.strength;
  const double specular = strength == 0.0 ? microfacetsOf(alpha, {0, 0, 1}, v, l)
                                          : anisotropicMicrofacets(glm::mix(alpha, 1.0, strength * strength),
                                                                   alpha, material.anisotropy.rotation, v, l);
  const FresnelPair fresnel = fresnelOf(material, glm::dot(v, glm::normalize(l + v)));
  const glm::dvec3 diffuse =
      (1.0 - material.transmission.factor) * glm::dvec3(material.baseColor) / glm::pi<double>();
  const glm::dvec3 dielectric =
      (1.0 - maximumOf(fresnel.dielectric)) * diffuse + fresnel.dielectric * specular;
  return glm::mix(dielectric, fresnel.metal * specular, double{material.metallic});
}

/// KHR_materials_sheen, white: D V.
inline double sheenReflectance(double roughness, glm::dvec3 v, glm::dvec3 l) {
  const double alpha = roughness * roughness, inverse = 1.0 / alpha;
  const auto curve = [&](double x) {
    const double smooth = squareOf(1.0 - alpha);
    const double a = glm::mix(21.5473, 25.3245, smooth), b = glm::mix(3.82987, 3.32435, smooth),
                 c = glm::mix(0.19823, 0.16801, smooth), d = glm::mix(-1.97760, -1.27393, smooth),
                 e = glm::mix(-4.32054, -4.85967, smooth);
    return a / (1.0 + b * std::pow(x, c)) + d * x + e;
  };
  const auto lambda = [&](double cosine) {
    return std::exp(cosine < 0.5 ? curve(cosine) : 2.0 * curve(0.5) - curve(1.0 - cosine));
  };
  const double nh = glm::normalize(l + v).z;
  return (2.0 + inverse) * std::pow(1.0 - nh * nh, inverse * 0.5) / (2.0 * glm::pi<double>()) /
         ((1.0 + lambda(v.z) + lambda(l.z)) * 4.0 * v.z * l.z);
}

/// How much a coat with this normal mirrors.
inline double coatShare(const Clearcoat& coat, glm::dvec3 n, glm::dvec3 v) {
  return coat.factor * schlick(0.04, glm::dot(n, v));
}

/// What is shown of a light of irradiance 1 on what faces it: sheen over the base, and a coat with
/// this normal over both.
inline glm::dvec3 shownOfLight(const PBROptions& material, const SheenTable& table, glm::dvec3 v,
                               glm::dvec3 l, glm::dvec3 coatNormal = {0, 0, 1}) {
  glm::dvec3 shown = l.z > 0.0 ? l.z * baseReflectance(material, v, l) : glm::dvec3(0.0);
  if (const glm::dvec3 sheen(material.sheen.color); sheen != glm::dvec3(0.0) && l.z > 0.0) {
    const double roughness = std::max(material.sheen.roughness, SheenTable::kSmoothest);
    const double share = std::max(table.at(static_cast<float>(v.z), static_cast<float>(roughness)),
                                  table.at(static_cast<float>(l.z), static_cast<float>(roughness)));
    shown = l.z * sheenReflectance(roughness, v, l) * sheen + (1.0 - maximumOf(sheen) * share) * shown;
  }
  if (const Clearcoat& coat = material.clearcoat; coat.factor > 0.0f) {
    const double nl = glm::dot(coatNormal, l), alpha = squareOf(std::max(coat.roughness, 0.045f));
    const double mirrored = nl > 0.0 ? nl * microfacetsOf(alpha, coatNormal, v, l) : 0.0;
    shown = glm::mix(shown, glm::dvec3(mirrored), coatShare(coat, coatNormal, v));
  }
  return shown;
}

}  // namespace weft::test
