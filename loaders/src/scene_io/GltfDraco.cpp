#include "GltfDraco.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft {
namespace {

bool lacksBytes(const GltfFile& file, int accessor) {
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= file.model.accessors.size()) return false;
  const tinygltf::Accessor& found = file.model.accessors[static_cast<std::size_t>(accessor)];
  return found.bufferView < 0 && !found.sparse.isSparse;
}

/// Whether a primitive has no other bytes than those in Draco.
bool isOnlyPacked(const GltfFile& file, const tinygltf::Primitive& primitive,
                  const tinygltf::Value& extension) {
  const tinygltf::Value& packed = extension.Get("attributes");
  return lacksBytes(file, primitive.indices) ||
         std::any_of(primitive.attributes.begin(), primitive.attributes.end(), [&](const auto& attribute) {
           return packed.Has(attribute.first) && lacksBytes(file, attribute.second);
         });
}

}  // namespace

Result<void> refuseDraco(const GltfFile& file) {
  for (std::size_t i = 0; i < file.model.meshes.size(); ++i)
    for (const tinygltf::Primitive& primitive : file.model.meshes[i].primitives) {
      const auto extension = primitive.extensions.find(kDracoExtension);
      if (extension != primitive.extensions.end() && isOnlyPacked(file, primitive, extension->second))
        return file.fail(
            fmt::format("mesh {} is there in {} alone, which Weft cannot unpack", i, kDracoExtension),
            "export it without compression");
    }
  return {};
}

}  // namespace weft
