#include "SceneDescription.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "weft/materials/LambertMaterial.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scene_io/MaterialSurface.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

/// Stand-ins for a file's materials, which say what they stand for.
struct NamedMaterials {
  std::map<std::shared_ptr<const Material>, GltfMaterial> sources;

  std::shared_ptr<const Material> of(const GltfMaterial& source) {
    for (const auto& [material, known] : sources)
      if (known.name == source.name && known.json == source.json) return material;
    auto material = std::make_shared<const LambertMaterial>();
    sources[material] = source;
    return material;
  }
};

Json describe(const MaterialSurface& surface, const NamedMaterials& materials) {
  const auto source = materials.sources.find(surface.material);
  const bool isNamed = source != materials.sources.end();
  Json json{{"name", isNamed ? source->second.name : ""},
            {"triangles", surface.triangles},
            {"area", surface.area},
            {"texture_coordinates", nullptr},
            {"unit_length", nullptr}};
  if (surface.textureArea > 0.0) {
    json["texture_coordinates"] = {{"u", {surface.minimum.x, surface.maximum.x}},
                                   {"v", {surface.minimum.y, surface.maximum.y}}};
    json["unit_length"] = surface.unitLength();
  }
  const Json own = isNamed ? Json::parse(source->second.json, nullptr, false) : Json();
  const Json::json_pointer field("/extensions/WEFT_materials_btf");
  if (own.is_object() && own.contains(field)) json["btf"] = own[field];
  return json;
}

Json describe(const GltfScene::NamedCamera& named) {
  return {{"name", named.name},
          {"projection", named.camera.isOrthographic() ? "orthographic" : "perspective"}};
}

Json describe(const glm::dvec3& vector) {
  return {vector.x, vector.y, vector.z};
}

}  // namespace

Result<Json> describeScene(const std::filesystem::path& file) {
  NamedMaterials materials;
  GltfOptions options;
  options.makeMaterial = [&](const GltfMaterial& source) -> Result<std::shared_ptr<const Material>> {
    return materials.of(source);
  };
  WEFT_TRY(const GltfScene scene, loadGltf(file, options));
  Json json{{"kind", "scene"},
            {"bounds", {{"min", describe(scene.bounds.minimum)}, {"max", describe(scene.bounds.maximum)}}},
            {"lights", scene.lights},
            {"cameras", Json::array()},
            {"animations", Json::array()},
            {"materials", Json::array()},
            {"warnings", scene.warnings}};
  for (const GltfScene::NamedCamera& camera : scene.cameras) json["cameras"].push_back(describe(camera));
  for (const GltfScene::Animation& animation : scene.animations)
    json["animations"].push_back({{"name", animation.name}, {"seconds", animation.seconds}});
  for (const MaterialSurface& surface : surfacesOf(*scene.root))
    json["materials"].push_back(describe(surface, materials));
  return json;
}

}  // namespace weft
