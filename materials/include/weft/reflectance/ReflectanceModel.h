#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Whether all views of a texel share one diffuse albedo, as in paper M eq. 1, or each has its own.
enum class DiffuseAlbedo { Shared, PerView };

/// What a file or a command line says of a model; the registry makes the model from it.
struct ModelDescription {
  std::string name = "rfnl";
  int lobes = 2;  ///< of the models that have lobes
  DiffuseAlbedo diffuseAlbedo = DiffuseAlbedo::Shared;
};

/// The formula RF_v(x, l) of one reflectance model: what its numbers are called and what they evaluate to.
/// The CPU reference for the GLSL file of the same name.
///
/// A texel has *shared* parameters (one set for all views) and *view* parameters (one set a measured view).
/// Immutable, thread safe.
class ReflectanceModel {
 public:
  virtual ~ReflectanceModel() = default;

  virtual ModelDescription description() const = 0;
  /// Channel names of the shared parameters, in the order in which evaluate() and the GLSL read them.
  virtual std::vector<std::string> sharedChannels() const = 0;
  /// Channel names of one view's parameters, likewise.
  virtual std::vector<std::string> viewChannels() const = 0;
  /// Linear RGB for light from the unit direction `light` (tangent frame), clamped at 0 (models.md, "Clamp");
  /// with or without n.l, as the fit was made. Spans are as long as the channel lists.
  virtual glm::vec3 evaluate(std::span<const float> shared, std::span<const float> view,
                             glm::vec3 light) const = 0;
  /// The GLSL file that computes the same ("rfnl.glsl"), and `#define`s for it.
  virtual std::string shaderFile() const = 0;
  virtual std::map<std::string, std::string> shaderDefines() const { return {}; }
};

/// Makes models by name. A value: build your own, or start from builtin() and add to it.
class ModelRegistry {
 public:
  using Factory = Result<std::shared_ptr<const ReflectanceModel>> (*)(const ModelDescription&);

  /// Every model of Weft.
  static ModelRegistry builtin();

  void add(std::string name, Factory factory);
  std::vector<std::string> names() const;
  /// Fails on an unknown name and on options that the model does not have.
  Result<std::shared_ptr<const ReflectanceModel>> create(const ModelDescription& description) const;

 private:
  std::vector<std::pair<std::string, Factory>> factories_;
};

}  // namespace weft
