#include "GltfDraco.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>

#ifdef WEFT_DRACO
#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
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

/// Fails where so many bytes more are not to be taken.
using TakeMemory = std::function<Result<void>(std::size_t)>;

#ifdef WEFT_DRACO

/// What the bytes claim to hold, and the decoder takes memory for before it looks whether they can.
struct Claims {
  bool isSequential = false;
  std::uint32_t triangles = 0;
  std::uint32_t vertices = 0;
  std::uint8_t seams = 0;  ///< attributes that are told apart where triangles meet

  std::size_t memory() const {
    constexpr std::size_t kMemoryPerElement = 64, kMemoryPerSeam = 32;
    return (std::size_t{triangles} + vertices) * (kMemoryPerElement + kMemoryPerSeam * seams);
  }
};

/// Of bitstream 2.2, which glTF names; false where it is something else.
bool readClaims(draco::DecoderBuffer buffer, Claims& claims) {
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return false;
  claims.isSequential = header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING;
  if (!claims.isSequential && header.encoder_method != draco::MESH_EDGEBREAKER_ENCODING) return false;
  if (header.encoder_type != draco::TRIANGULAR_MESH || header.version_major != 2 || header.version_minor != 2)
    return false;
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
  draco::GeometryMetadata metadata;
  if ((header.flags & METADATA_FLAG_MASK) != 0 &&
      !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
    return false;
  if (claims.isSequential)
    return draco::DecodeVarint(&claims.triangles, &buffer) && draco::DecodeVarint(&claims.vertices, &buffer);
  std::uint8_t traversal = 0;
  return buffer.Decode(&traversal) && draco::DecodeVarint(&claims.vertices, &buffer) &&
         draco::DecodeVarint(&claims.triangles, &buffer) && buffer.Decode(&claims.seams);
}

/// Whether texture coordinates have no more orientations than values, as Draco's encoder sees to:
/// its decoder believes their number, which costs 512 MB and 20 seconds where it is broken. The
/// buffer stands after the names of the prediction and of its transform.
bool hasSoundOrientations(draco::DecoderBuffer buffer, std::size_t entries) {
  constexpr std::size_t kComponents = 2;
  const char method = buffer.data_head()[-2];
  const bool isVarint = method == draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED;
  if (method != draco::MESH_PREDICTION_TEX_COORDS_PORTABLE && !isVarint) return true;
  std::uint8_t isCompressed = 0, numberSize = 0;
  if (!buffer.Decode(&isCompressed)) return false;
  if (isCompressed != 0) {
    std::vector<std::uint32_t> values(entries * kComponents);
    if (!draco::DecodeSymbols(static_cast<std::uint32_t>(values.size()), kComponents, &buffer, values.data()))
      return false;
  } else {
    if (!buffer.Decode(&numberSize)) return false;
    const auto size = static_cast<std::int64_t>(entries * kComponents * numberSize);
    if (size > buffer.remaining_size()) return false;
    buffer.Advance(size);
  }
  std::uint32_t orientations = 0;
  return (isVarint ? draco::DecodeVarint(&orientations, &buffer) : buffer.Decode(&orientations)) &&
         orientations <= entries;
}

/// What one of Draco's decoders was not to do.
struct Refusal {
  Result<void> memory{};
  bool isBroken = false;
};

/// One of Draco's decoders, which asks for the memory of the attributes once it knows them: a few
/// bytes name many, of many components.
template <class Decoder>
class FrugalDecoder : public Decoder {
 public:
  FrugalDecoder(const draco::DecoderBuffer& buffer, const TakeMemory& take, Refusal& refusal)
      : buffer_(buffer), take_(take), refusal_(refusal) {}

  /// Draco asks when it has read how an attribute is predicted.
  const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int attribute) const override {
    const auto* data = Decoder::GetAttributeEncodingData(attribute);
    if (!data || hasSoundOrientations(buffer_, data->encoded_attribute_value_index_to_corner_map.size()))
      return data;
    refusal_.isBroken = true;
    return nullptr;  // decoded without prediction
  }

 protected:
  bool DecodeAllAttributes() override {
    std::size_t memoryPerPoint = 0;
    for (std::int32_t i = 0; i < this->point_cloud()->num_attributes(); ++i)
      memoryPerPoint += memoryPerPointOf(*this->point_cloud()->attribute(i));
    refusal_.memory = take_(this->point_cloud()->num_points() * memoryPerPoint);
    return refusal_.memory && Decoder::DecodeAllAttributes();
  }

 private:
  static std::size_t memoryPerPointOf(const draco::PointAttribute& attribute) {
    const auto component = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type()));
    // Whole numbers, then as they are, then for an accessor; and which of them a point has.
    return static_cast<std::size_t>(attribute.num_components()) * (sizeof(std::int32_t) + 2 * component) +
           sizeof(std::uint32_t);
  }

  const draco::DecoderBuffer& buffer_;
  const TakeMemory& take_;
  Refusal& refusal_;
};

template <class Number>
bool copyValues(const draco::PointAttribute& source, std::uint32_t count, std::vector<std::uint8_t>& target) {
  const auto components = static_cast<std::uint8_t>(source.num_components());
  const std::size_t size = components * sizeof(Number);
  std::vector<Number> value(components);
  target.resize(count * size);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!source.ConvertValue<Number>(source.mapped_index(draco::PointIndex(i)), value.data())) return false;
    std::memcpy(target.data() + i * size, value.data(), size);
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

/// False where the accessor does not exist.
bool setIndices(GltfFile& file, const draco::Mesh& mesh, tinygltf::Primitive& primitive) {
  if (primitive.indices < 0) {
    primitive.indices = static_cast<int>(file.model.accessors.size());
    file.model.accessors.emplace_back();
  }
  if (static_cast<std::size_t>(primitive.indices) >= file.model.accessors.size()) return false;
  std::vector<std::uint8_t> bytes(mesh.num_faces() * 3 * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    const std::uint32_t corners[3]{face[0].value(), face[1].value(), face[2].value()};
    std::memcpy(bytes.data() + i * sizeof corners, corners, sizeof corners);
  }
  tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(primitive.indices)];
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  setBytes(file, accessor, mesh.num_faces() * std::size_t{3}, std::move(bytes));
  primitive.mode = TINYGLTF_MODE_TRIANGLES;  // whatever strips there were
  return true;
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

template <class Decoder>
Result<bool> decodeWith(draco::DecoderBuffer& buffer, const TakeMemory& take, draco::Mesh& mesh) {
  Refusal refusal;
  FrugalDecoder<Decoder> decoder(buffer, take, refusal);
  const bool isDecoded = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
  WEFT_TRY_VOID(refusal.memory);
  return isDecoded && !refusal.isBroken;
}

/// `name` is for people.
Result<std::unique_ptr<draco::Mesh>> decoded(const GltfFile& file, std::span<const std::uint8_t> bytes,
                                             const std::string& name, const TakeMemory& take) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Claims claims;
  if (!readClaims(buffer, claims)) return file.fail(name + " is not a mesh of Draco's bitstream 2.2");
  WEFT_TRY_VOID(take(claims.memory()));
  auto mesh = std::make_unique<draco::Mesh>();
  bool isDecoded = false;
  try {
    WEFT_TRY(isDecoded, claims.isSequential ? decodeWith<draco::MeshSequentialDecoder>(buffer, take, *mesh)
                                            : decodeWith<draco::MeshEdgebreakerDecoder>(buffer, take, *mesh));
  } catch (const std::exception&) {  // of numbers that no vector has room for
  }
  if (!isDecoded) return file.fail(name + " is broken");
  return mesh;
}

Result<void> unpack(GltfFile& file, tinygltf::Primitive& primitive, const tinygltf::Value& extension,
                    const std::string& name, const TakeMemory& take) {
  WEFT_TRY(const std::span<const std::uint8_t> bytes,
           viewBytes(file, extension.Get("bufferView").GetNumberAsInt()));
  WEFT_TRY(const std::unique_ptr<draco::Mesh> mesh, decoded(file, bytes, name, take));
  if (!setIndices(file, *mesh, primitive))
    return file.fail(name + " has indices whose accessor does not exist");
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
                    const TakeMemory&) {
  return file.fail(name + " cannot be unpacked by this build of Weft", "export it without compression");
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
      const std::string name = fmt::format("the {} of mesh {}", kDracoExtension, i);
      const TakeMemory take = [&](std::size_t bytes) { return file.checkMemory(taken += bytes, name); };
      WEFT_TRY_VOID(unpack(file, primitive, extension->second, name, take));
    }
  return {};
}

}  // namespace weft
