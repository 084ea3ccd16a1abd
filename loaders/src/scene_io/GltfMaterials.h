#pragma once

#include <array>
#include <compare>
#include <map>
#include <memory>
#include <utility>

#include "GltfFile.h"
#include "GltfTextures.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scene_io/GltfLoader.h"

namespace weft {

/// What glTF makes lighting depend on: lines and points without normals are shown without it, those
/// without tangents have nothing that lies along them.
enum class Shading { Full, WithoutTangents, Unlit };

/// What a primitive has that its material depends on.
struct Wearer {
  Shading shading = Shading::Full;
  bool hasAlpha = false;  ///< in the colours of its vertices

  auto operator<=>(const Wearer&) const = default;
};

/// A material, and what it asks of the meshes that wear it.
struct MeshDress {
  std::shared_ptr<const Material> material{};
  /// the file's texture coordinates that become the mesh's two sets
  std::array<int, 2> sets{0, 1};
  int tangentSet = 0;            ///< which of the file's the file's tangents belong to
  TexturePlacement placement{};  ///< of the mesh's first set, tangents included
  bool usesTexcoords = false;
  bool usesTangents = false;  ///< beyond those of a normal texture
};

/// Makes the materials of a file when they are first asked for, so that what nothing uses, or what
/// the options replace, may lack its files.
class GltfMaterials {
 public:
  /// All three must outlive this.
  GltfMaterials(const GltfFile& file, const GltfOptions& options, std::vector<std::string>& warnings)
      : file_(file),
        options_(options),
        warnings_(warnings),
        textures_(file, warnings),
        fields_(options.fields ? options.fields : std::make_shared<FieldCache>(options.models)) {}

  /// `index` -1: glTF's default material.
  Result<MeshDress> get(int index, Wearer wearer);
  /// Of all that get() was asked for.
  std::vector<std::string> names() const;
  /// Of these, the ones with a reflectance field.
  const std::vector<GltfScene::FieldMaterial>& fields() const { return fieldMaterials_; }

 private:
  Result<MeshDress> make(int index, const tinygltf::Material& material, const Wearer& wearer);
  /// Where the reflectance field is missing or broken, of the material's own maps, with a warning.
  Result<MeshDress> makeBtf(const tinygltf::Material& material, const Wearer& wearer);
  Result<std::shared_ptr<BTFMaterial>> loadField(const tinygltf::Material& material,
                                                 const tinygltf::Value& extension,
                                                 const BTFMaterialOptions& options);
  Result<MeshDress> makePbr(const tinygltf::Material& material, const Wearer& wearer);
  /// Whether nothing shines through although the file calls it blended, as Blender does of what it
  /// exports: without depth the far side of a mesh would show through its near one.
  bool isOpaque(const PBROptions& options, const Wearer& wearer) const;

  const GltfFile& file_;
  const GltfOptions& options_;
  std::vector<std::string>& warnings_;
  GltfTextures textures_;
  std::shared_ptr<FieldCache> fields_;
  std::map<std::pair<int, Wearer>, MeshDress> made_;
  std::vector<GltfScene::FieldMaterial> fieldMaterials_;
};

}  // namespace weft
