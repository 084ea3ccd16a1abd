#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/scene_io/FieldCache.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/Node.h"

namespace weft {

/// An extension that Weft does not know, or an application's extras, kept as data.
struct GltfData {
  /// JSON pointer to the object that has it: "/nodes/3"; "" for the file itself
  std::string place;
  std::string name;  ///< of the extension, or "extras"
  std::string json;  ///< its value, as JSON text
};

/// A material as a file describes it, for a program that makes materials of its own.
struct GltfMaterial {
  std::filesystem::path file;  ///< references in the JSON are relative to its folder
  std::string name;
  std::string json;  ///< the whole object, extensions and extras included
};

struct GltfOptions {
  /// Materials to use instead of the file's, by its names for them; "*" for all that are not named.
  /// What they replace is not read.
  std::map<std::string, std::shared_ptr<const Material>> replacements{};
  bool lights = true;    ///< false leaves the file's lights out, for a program that brings its own
  bool shadows = false;  ///< whether the file's lights cast shadows
  /// For materials with WEFT_materials_btf; textureScale is multiplied by the extension's `scale`.
  BTFMaterialOptions btf{};
  /// That their fields may be of.
  ModelRegistry models = ModelRegistry::builtin();
  /// Where the fields of those come from, instead of models; null: each is read once for this file.
  std::shared_ptr<FieldCache> fields{};
  /// Poses the scene as one of its animations has it so many seconds after its start; none: as it
  /// was modelled. Before the first and after the last key a value stays as it is there.
  std::optional<double> time{};
  std::string animation{};  ///< the name of that animation; empty: the first
  /// Makes the materials that are not replaced; null leaves one to Weft.
  std::function<Result<std::shared_ptr<const Material>>(const GltfMaterial&)> makeMaterial{};
  /// The program's own extensions, by name, which files may then require. Each is called wherever
  /// the file has it, once the scene is complete; `node` is the one that came out of a glTF node of
  /// the scene, otherwise null.
  std::map<std::string, std::function<Result<void>(const GltfData&, Node* node)>> extensions{};
};

/// A glTF file as Weft's scene graph.
struct GltfScene {
  struct NamedCamera {
    std::string name;  ///< of the camera, or else of its node; may be empty
    Camera camera;
  };
  struct Animation {
    std::string name;
    double seconds;  ///< from 0 to the last key
  };
  /// A material with WEFT_materials_btf, to be shown otherwise: BTFMaterial::setOptions().
  struct FieldMaterial {
    std::string name;  ///< of the material
    std::filesystem::path file;
    std::shared_ptr<BTFMaterial> material;
  };

  std::shared_ptr<Node> root;
  std::vector<NamedCamera> cameras;  ///< in the order of their nodes
  /// names of all materials that something is drawn with; "" has none
  std::vector<std::string> materials;
  std::vector<FieldMaterial> fields;  ///< that something is drawn with
  std::vector<Animation> animations;  ///< all that the file has
  std::vector<GltfData> data;         ///< unknown extensions and extras, in the order of the file
  int lights = 0;
  Bounds bounds;
  /// that its uris name: buffers, images, fields, there or not
  std::vector<std::filesystem::path> files;
  /// what of the file is not shown, or not as it says, a sentence each
  std::vector<std::string> warnings;
};

/// Reads the default scene of a glTF 2.0 file, .gltf or .glb: nodes, meshes of every kind of
/// primitive (morphed and skinned as they stand at the time that the options name; instanced;
/// packed with Draco or meshoptimizer, where this build has them), lights (KHR_lights_punctual),
/// cameras, materials.
///
/// A material with `WEFT_materials_btf` (`uri` of a .rf.exr beside the file, `scale`) becomes a
/// BTFMaterial, any other a PBRMaterial (KHR_materials_emissive_strength, _ior, _specular,
/// _pbrSpecularGlossiness, _unlit, KHR_texture_transform; two of a primitive's sets of texture
/// coordinates). Normals and tangents that a file leaves out are generated. An image or a .rf.exr
/// that is missing or broken is left out with a warning.
///
/// Files are not trusted: everything is checked against its type and bounds, and memory is taken
/// for no more than a file of its size needs. Fails, with file and reason, on anything broken, on a
/// missing buffer, on a required extension that neither Weft nor the options know, and where
/// nothing is drawn. Touches no GL.
Result<GltfScene> loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace weft
