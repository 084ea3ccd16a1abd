#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/Node.h"

namespace weft {

struct GltfOptions {
  /// Materials to use instead of the file's, by its names for them; "*" for all that are not named. What they
  /// replace is not read.
  std::map<std::string, std::shared_ptr<const Material>> replacements;
  bool lights = true;  ///< false leaves the file's lights out, for a program that brings its own
  /// For materials with WEFT_materials_btf; textureScale is multiplied by the extension's `scale`.
  BTFMaterialOptions btf;
};

/// A glTF file as Weft's scene graph.
struct GltfScene {
  struct NamedCamera {
    std::string name;  ///< of the camera, or else of its node; may be empty
    Camera camera;
  };

  std::shared_ptr<Node> root;
  std::vector<NamedCamera> cameras;    ///< perspective ones, in the order of their nodes
  std::vector<std::string> materials;  ///< names of all materials that something is drawn with; "" has none
  int lights = 0;                      ///< point and directional
  Bounds bounds;
  std::vector<std::string> warnings;  ///< what of the file is not shown, a sentence each
};

/// Reads the default scene of a glTF 2.0 file, .gltf or .glb: nodes, triangles, point and directional lights
/// (KHR_lights_punctual), perspective cameras, materials.
///
/// A material with `WEFT_materials_btf` (`uri` of a .rf.exr beside the file, `scale`) becomes a BTFMaterial,
/// any other a LambertMaterial of its base colour. Normals and tangents that a file leaves out are
/// generated. Files are not trusted: everything is checked against its bounds. Fails, with file and reason,
/// on anything broken, on a missing buffer, .rf.exr or base colour texture, and where nothing is drawn.
/// Touches no GL.
Result<GltfScene> loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace weft
