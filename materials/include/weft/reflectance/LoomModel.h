#pragma once

#include "weft/reflectance/GlossLobe.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// `loom`: weights of a texel times components that all texels share, registered for the surface's
/// relief.
///
///     Y = sum_k W_k M_ik(l)             luminance, for view i and light l, without n.l
///     (dR, dB) = sum_{k<2} W_k C_ik(l)  hue that changes with the directions; dG keeps Y
///     RGB = max(0, c Y + (dR, dG, dB))
///
/// W: shared numbers in -1..1; c: the base colour, of a luminance of about 1. M and C: a map of the
/// lights a view (LightMap.h), its layer. For light of environments, polynomials of the light come
/// closest to the maps (kTerms; of components from kQuadratic on three of them): moments of the
/// environment integrate these. W may be filtered between texels and averaged for coarser levels,
/// because light is linear in it; base colours are fitted anew for those.
///
/// `loom_gloss` is the same plus a lobe a texel (GlossLobe.h), white, whose numbers stand before W:
/// RGB = max(0, c Y + (dR, dG, dB) + lobe).
class LoomModel : public ReflectanceModel {
 public:
  static std::vector<ModelType> types();
  LoomModel(ModelOptions options, bool hasGloss)
      : ReflectanceModel(std::move(options)), hasGloss_(hasGloss) {}

  /// Of l: xx, yy, xy, x, y, 1, as `rfp` has.
  static constexpr int kTerms = 6;
  /// The components that have all of them; the others are linear.
  static constexpr int kQuadratic = 16;

  bool hasGloss() const { return hasGloss_; }
  /// Of the shared channels, the first weight.
  std::size_t firstWeight() const { return 3 + (hasGloss_ ? GlossLobe::kNumbers : 0); }
  int components() const { return options().number("components"); }
  /// Numbers of a texel of a light map: M, then C of red and of blue, two each.
  int mapChannels() const { return components() + 4; }

  std::vector<std::string> sharedParameters() const override;
  bool filtersParameters() const override { return true; }
  std::vector<ModelTable> tables() const override;
  Result<std::shared_ptr<const ReflectanceModel>> bind(
      std::shared_ptr<const FieldTables> tables) const override;
  std::span<const float> commonLayer(int layer) const override;
  const Registration& registration() const override { return registration_; }

  /// Y.
  float evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                 glm::vec3 view) const override;
  glm::vec3 evaluateColor(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                          glm::vec3 view) const override;
  void evaluateColors(std::span<const float> shared, std::span<const float> layer,
                      std::span<const glm::vec3> lights, glm::vec3 view,
                      std::span<glm::vec3> colors) const override;
  std::vector<float> sampledLayer(std::span<const float> layer,
                                  std::span<const glm::vec3> lights) const override;
  void evaluateSampled(std::span<const float> shared, std::span<const float> sampled,
                       std::span<const glm::vec3> lights, glm::vec3 view,
                       std::span<glm::vec3> colors) const override;

  bool integratesEnvironments() const override { return true; }
  glm::vec3 colorUnderEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3 view,
                                  const EnvironmentIntegrals& light) const override;

  std::string shaderFile() const override { return "loom.glsl"; }
  std::map<std::string, std::string> shaderDefines() const override;

 private:
  bool hasGloss_;
  /// `[row][column][channel]` of a view's map, then `[term][channel]` of its polynomials
  std::vector<std::vector<float>> layers_;
  int mapSize_ = 0;
  Registration registration_;
};

}  // namespace weft
