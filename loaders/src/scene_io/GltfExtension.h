#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <string>

#include "GltfFile.h"
#include "GltfTextures.h"
#include "weft/materials/PBROptions.h"

namespace weft {

/// A factor as glTF means it: 0 to 1.
inline float unitFactor(double factor) {
  return static_cast<float>(std::clamp(factor, 0.0, 1.0));
}

/// Reads the members of an extension of a material. What is not there is `otherwise`, or no
/// texture; all fail where the file is wrong.
class GltfExtension {
 public:
  /// All must outlive this. `material` is for people: "of material "seat"".
  GltfExtension(const GltfFile& file, GltfTextures& textures, const char* name, const tinygltf::Value& value,
                const std::string& material)
      : file_(file), textures_(textures), name_(name), value_(value), material_(material) {}

  Result<double> number(const char* key, double otherwise) const;
  /// A number from 0 to 1; others become the nearer of these.
  Result<float> factor(const char* key, double otherwise) const;
  /// Not negative.
  Result<glm::vec3> color(const char* key, double otherwise) const;
  /// `what`: "specular colour", for people.
  Result<PBRTexture> texture(const char* key, bool srgb, const std::string& what) const;
  /// A factor and the texture that it multiplies; 0 where the file names one that cannot be shown:
  /// without it the factor means nothing.
  Result<void> texturedFactor(const char* key, const char* textureKey, const std::string& what, float& factor,
                              PBRTexture& texture) const;

  bool has(const char* key) const { return value_.Has(key); }
  const tinygltf::Value& value() const { return value_; }

 private:
  const GltfFile& file_;
  GltfTextures& textures_;
  const char* name_;
  const tinygltf::Value& value_;
  const std::string& material_;
};

}  // namespace weft
