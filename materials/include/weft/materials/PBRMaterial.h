#pragma once

#include "weft/materials/ChunkMaterial.h"
#include "weft/materials/PBROptions.h"

namespace weft {

/// A surface as nearly every glTF file describes it (glTF 2.0, appendix B): a diffuse dielectric
/// below GGX microfacets, mixed with a metal, under point and directional lights and an
/// environment.
///
/// Multiplies by the mesh's vertex colours. Numbers must be finite, factors within 0..1. The
/// formula: specular = D V with GGX and Smith's height-correlated shadowing; metal = specular
/// mix(base, 1, w); dielectric = (1 - max F) base / pi + F specular with F = mix(F0, F90, w), w =
/// (1 - v.h)^5; mixed by `metallic`. Under an environment specular becomes a split sum:
/// MicrofacetTable times the average of what the microfacets mirror. GLSL: shaders/pbr.frag.
///
/// Layers of Khronos' extensions (PBROptions.h) are compiled in where their factors are not 0, each
/// from a file of its own: clearcoat.glsl, sheen.glsl, anisotropy.glsl, iridescence.glsl,
/// transmission.glsl. The coat lies over the sheen, and that over the rest. What they approximate:
/// docs/gltf.md.
class PBRMaterial : public ChunkMaterial {
 public:
  explicit PBRMaterial(const PBROptions& options = {});

  const PBROptions& options() const { return options_; }
  const State* coverage() const override;

 private:
  PBROptions options_;
  State coverage_;
};

}  // namespace weft
