#include "GltfInstances.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "GltfAccessor.h"

namespace weft {
namespace {

/// One vector an instance; `otherwise` where the extension has no such attribute.
template <class Vector>
Result<std::vector<Vector>> attributeOf(const GltfFile& file, const tinygltf::Value& attributes,
                                        const char* name, std::size_t count, Vector otherwise) {
  if (!attributes.Has(name)) return std::vector<Vector>(count, otherwise);
  return readVectors<Vector>(file, attributes.Get(name).GetNumberAsInt());
}

/// How many there are: the length of all attributes, those of other programs included.
Result<std::size_t> instanceCount(const GltfFile& file, const tinygltf::Value& attributes) {
  std::optional<std::size_t> count;
  for (const std::string& name : attributes.Keys()) {
    WEFT_TRY(const std::size_t length, countOf(file, attributes.Get(name).GetNumberAsInt()));
    if (count && *count != length)
      return file.fail(fmt::format("the attributes of {} differ in length", kInstancingExtension));
    count = length;
  }
  if (!count) return file.fail(fmt::format("{} has no attributes", kInstancingExtension));
  WEFT_TRY_VOID(file.checkMemory(*count * sizeof(glm::mat4) * 2, kInstancingExtension));
  return *count;
}

}  // namespace

Result<std::vector<glm::mat4>> instancesOf(const GltfFile& file, const tinygltf::Value& extension) {
  const tinygltf::Value& attributes = extension.Get("attributes");
  WEFT_TRY(const std::size_t count, instanceCount(file, attributes));
  WEFT_TRY(const auto translations, attributeOf(file, attributes, "TRANSLATION", count, glm::vec3(0.0f)));
  WEFT_TRY(const auto rotations, attributeOf(file, attributes, "ROTATION", count, glm::vec4(0, 0, 0, 1)));
  WEFT_TRY(const auto scales, attributeOf(file, attributes, "SCALE", count, glm::vec3(1.0f)));
  std::vector<glm::mat4> instances;
  instances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::quat rotation =
        glm::normalize(glm::quat(rotations[i].w, rotations[i].x, rotations[i].y, rotations[i].z));
    const glm::mat4 matrix = glm::translate(glm::mat4(1.0f), translations[i]) * glm::mat4_cast(rotation);
    instances.push_back(glm::scale(matrix, scales[i]));
    if (!isFinite(instances.back()))
      return file.fail("instance " + std::to_string(i) + " of " + kInstancingExtension +
                       " has a broken transform");
  }
  return instances;
}

}  // namespace weft
