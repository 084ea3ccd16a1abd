#pragma once

#include "weft/reflectance/ModelRegistry.h"
#include "weft/reflectance/PhongMean.h"

namespace weft {

/// `lod`: a Laplacian pyramid whose levels are weights times components ([Ma 2005]).
///
///     (Y, Cb, Cr) = mean(l, v) + sum_k s_k sum_j W_kj E_kj,i(l)   for view i and light l
///     mean        = (ka + kd l.z + ks h.z^a, Cb, Cr),  h between l and v
///     RGB         = max(0, that)                       full-range Rec. 601
///
/// W_k: the shared numbers of level k, in -1..1; each of Y, Cb and Cr has components of its own.
/// E_kj,i, an *eigen-BRDF*: a map of the lights a view (LightMap.h). s_k: LevelSum.h. Base colours
/// are white. For light of environments, polynomials of the light (kTerms) come closest to the maps
/// and to the mean at each view: moments of the environment integrate these.
class LodModel : public ReflectanceModel {
 public:
  static ModelType type();
  explicit LodModel(ModelOptions options) : ReflectanceModel(std::move(options)) {}

  /// The numbers of the table `mean`: those of PhongMean, Cb and Cr, and how many levels there are.
  enum Mean { Ambient, Diffuse, Specular, Exponent, MeanCb, MeanCr, Levels };
  /// Of l: xx, yy, xy, x, y, 1, as `rfp` has.
  static constexpr int kTerms = 6;
  /// The deepest pyramid: of 2^20 texels a side.
  static constexpr int kMostLevels = 20;

  /// Components of Y, and of Cb and Cr each, of a level.
  int components() const { return options().number("components"); }
  int chroma() const { return options().number("chroma"); }
  /// Components of a level.
  int numbersOfLevel() const { return components() + 2 * chroma(); }

  std::vector<std::string> sharedParameters() const override;
  int summedLevels() const override { return levels_; }
  std::vector<ModelTable> tables() const override;
  Result<std::shared_ptr<const ReflectanceModel>> bind(
      std::shared_ptr<const FieldTables> tables) const override;
  std::span<const float> commonLayer(int layer) const override;

  /// The luminance of evaluateColor().
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

  std::string shaderFile() const override { return "lod.glsl"; }
  std::map<std::string, std::string> shaderDefines() const override;

 private:
  int levels_ = 1;  // of an unbound one: that there are any
  int mapSize_ = 0;
  PhongMean mean_;
  glm::vec2 meanChroma_{0.0f};
  /// `[level][row][column][component]` of a view's maps, then `[level][term][component]` of their
  /// polynomials and `[term]` of the mean's
  std::vector<std::vector<float>> layers_;
};

/// The colours of full-range Rec. 601: Y, Cb, Cr of a colour, Cb and Cr around 0, and back.
glm::vec3 yCbCrFromRgb(glm::vec3 rgb);
glm::vec3 rgbFromYCbCr(glm::vec3 yCbCr);

}  // namespace weft
