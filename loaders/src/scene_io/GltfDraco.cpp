#include "GltfDraco.h"

#include <algorithm>
#include <cstring>
#include <exception>

#ifdef WEFT_DRACO
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#endif

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

#ifdef WEFT_DRACO

/// How many triangles and vertices the bytes claim to hold: the decoder takes memory for them at once.
struct Claims {
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;
};

/// Of bitstream 2.2, which glTF names; false where it is something else.
bool readClaims(draco::DecoderBuffer buffer, Claims& claims) {
  constexpr std::uint8_t kSequential = 0, kMesh = 1;
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return false;
  if (header.encoder_type != kMesh || header.version_major != 2 || header.version_minor != 2) return false;
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
  draco::GeometryMetadata metadata;
  if ((header.flags & METADATA_FLAG_MASK) != 0 &&
      !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
    return false;
  std::uint8_t traversal = 0;
  if (header.encoder_method == kSequential)
    return draco::DecodeVarint(&claims.triangles, &buffer) && draco::DecodeVarint(&claims.vertices, &buffer);
  return buffer.Decode(&traversal) && draco::DecodeVarint(&claims.vertices, &buffer) &&
         draco::DecodeVarint(&claims.triangles, &buffer);
}

template <class Number>
bool copyValues(const draco::PointAttribute& source, std::uint32_t count, std::vector<std::uint8_t>& target) {
  const std::size_t components = static_cast<std::size_t>(source.num_components());
  std::vector<Number> value(components);
  target.resize(count * components * sizeof(Number));
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!source.ConvertValue<Number>(source.mapped_index(draco::PointIndex(i)), value.data())) return false;
    std::memcpy(target.data() + i * components * sizeof(Number), value.data(), components * sizeof(Number));
  }
  return true;
}

bool copyValues(const draco::PointAttribute& source, std::uint32_t count, int componentType,
                std::vector<std::uint8_t>& target) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return copyValues<std::int8_t>(source, count, target);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copyValues<std::uint8_t>(source, count, target);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return copyValues<std::int16_t>(source, count, target);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copyValues<std::uint16_t>(source, count, target);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copyValues<std::uint32_t>(source, count, target);
    default:
      return componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && copyValues<float>(source, count, target);
  }
}

/// Puts an accessor's elements where these bytes are.
void setBytes(GltfFile& file, tinygltf::Accessor& accessor, std::size_t count,
              std::vector<std::uint8_t> bytes) {
  tinygltf::BufferView view;
  view.byteLength = bytes.size();
  view.buffer = file.addBuffer(std::move(bytes));
  accessor.bufferView = static_cast<int>(file.model.bufferViews.size());
  accessor.byteOffset = 0;
  accessor.count = count;
  file.model.bufferViews.push_back(view);
}

void setIndices(GltfFile& file, const draco::Mesh& mesh, tinygltf::Primitive& primitive) {
  if (primitive.indices < 0) {
    primitive.indices = static_cast<int>(file.model.accessors.size());
    file.model.accessors.emplace_back();
  }
  std::vector<std::uint8_t> bytes(mesh.num_faces() * 3 * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    const std::uint32_t corners[3]{face[0].value(), face[1].value(), face[2].value()};
    std::memcpy(bytes.data() + i * sizeof corners, corners, sizeof corners);
  }
  tinygltf::Accessor& accessor = file.model.accessors.at(static_cast<std::size_t>(primitive.indices));
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  setBytes(file, accessor, mesh.num_faces() * std::size_t{3}, std::move(bytes));
  primitive.mode = TINYGLTF_MODE_TRIANGLES;  // whatever strips there were
}

/// What is wrong with an attribute; null where it was set.
const char* setAttribute(GltfFile& file, const draco::Mesh& mesh, int id, int accessorIndex) {
  const draco::PointAttribute* source =
      id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
  if (!source || static_cast<std::size_t>(accessorIndex) >= file.model.accessors.size())
    return "does not exist";
  tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(accessorIndex)];
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != source->num_components())
    return "has another number of components than its accessor";
  std::vector<std::uint8_t> bytes;
  if (!copyValues(*source, mesh.num_points(), accessor.componentType, bytes))
    return "has values that do not fit its accessor";
  setBytes(file, accessor, mesh.num_points(), std::move(bytes));
  return nullptr;
}

/// `name` is for people; `taken`: the memory of all that is decoded.
Result<std::unique_ptr<draco::Mesh>> decoded(const GltfFile& file, std::span<const std::uint8_t> bytes,
                                             const std::string& name, std::size_t& taken) {
  constexpr std::size_t kMemoryPerElement = 64;
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Claims claims;
  const auto broken = [&] { return file.fail(name + " is broken"); };
  if (!readClaims(buffer, claims)) return file.fail(name + " is not a mesh of Draco's bitstream 2.2");
  taken += (std::size_t{claims.triangles} + claims.vertices) * kMemoryPerElement;
  WEFT_TRY_VOID(file.checkMemory(taken, name));
  try {
    auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) return broken();
    return std::move(mesh).value();
  } catch (const std::exception&) {
    return broken();
  }
}

Result<void> unpack(GltfFile& file, tinygltf::Primitive& primitive, const tinygltf::Value& extension,
                    const std::string& name, std::size_t& taken) {
  WEFT_TRY(const std::span<const std::uint8_t> bytes,
           viewBytes(file, extension.Get("bufferView").GetNumberAsInt()));
  WEFT_TRY(const std::unique_ptr<draco::Mesh> mesh, decoded(file, bytes, name, taken));
  setIndices(file, *mesh, primitive);
  const tinygltf::Value& packed = extension.Get("attributes");
  for (const auto& [attribute, accessor] : primitive.attributes) {
    if (!packed.Has(attribute)) continue;
    const char* wrong = setAttribute(file, *mesh, packed.Get(attribute).GetNumberAsInt(), accessor);
    if (wrong) return file.fail(name + " holds no " + attribute + ": it " + wrong);
  }
  return {};
}

#else

Result<void> unpack(GltfFile& file, tinygltf::Primitive&, const tinygltf::Value&, const std::string& name,
                    std::size_t&) {
  return file.fail(name + " cannot be unpacked by this build of Weft");
}

#endif

}  // namespace

#ifdef WEFT_DRACO
const bool kUnpacksDraco = true;
#else
const bool kUnpacksDraco = false;
#endif

Result<void> unpackDraco(GltfFile& file) {
  std::size_t taken = 0;
  for (std::size_t i = 0; i < file.model.meshes.size(); ++i)
    for (tinygltf::Primitive& primitive : file.model.meshes[i].primitives) {
      const auto extension = primitive.extensions.find(kDracoExtension);
      if (extension == primitive.extensions.end() || !isOnlyPacked(file, primitive, extension->second))
        continue;
      const std::string name = "the " + std::string(kDracoExtension) + " of mesh " + std::to_string(i);
      WEFT_TRY_VOID(unpack(file, primitive, extension->second, name, taken));
    }
  return {};
}

}  // namespace weft
