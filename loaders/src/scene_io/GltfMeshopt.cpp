#include "GltfMeshopt.h"

#ifdef WEFT_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace weft {
namespace {

/// What EXT_meshopt_compression says of a buffer view.
struct PackedView {
  std::span<const std::uint8_t> bytes{};
  std::size_t count = 0;
  std::size_t stride = 0;
  std::string mode;
  std::string filter;
};

#ifdef WEFT_MESHOPTIMIZER

/// Whether the library takes such numbers; it only asserts them.
bool isValid(const PackedView& view) {
  const bool isIndices = view.mode == "TRIANGLES" || view.mode == "INDICES";
  if (isIndices && view.stride != 2 && view.stride != 4) return false;
  if (view.mode == "TRIANGLES") return view.count % 3 == 0;
  if (view.mode == "INDICES") return true;
  const std::size_t stride = view.stride;
  const bool fitsFilter = view.filter == "OCTAHEDRAL"    ? stride == 4 || stride == 8
                          : view.filter == "QUATERNION"  ? stride == 8
                          : view.filter == "EXPONENTIAL" ? true
                                                         : view.filter == "NONE";
  return view.mode == "ATTRIBUTES" && stride > 0 && stride <= 256 && stride % 4 == 0 && fitsFilter;
}

/// False where the bytes are broken.
bool unpack(const PackedView& view, std::vector<std::uint8_t>& target) {
  const std::uint8_t* bytes = view.bytes.data();
  const std::size_t size = view.bytes.size();
  if (view.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(target.data(), view.count, view.stride, bytes, size) == 0;
  if (view.mode == "INDICES")
    return meshopt_decodeIndexSequence(target.data(), view.count, view.stride, bytes, size) == 0;
  if (meshopt_decodeVertexBuffer(target.data(), view.count, view.stride, bytes, size) != 0) return false;
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(target.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(target.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(target.data(), view.count, view.stride);
  return true;
}

#else

bool isValid(const PackedView&) {
  return false;
}
bool unpack(const PackedView&, std::vector<std::uint8_t>&) {
  return false;
}

#endif

/// A member that readGltfFile() has seen to be a number, as a whole one.
std::size_t sizeOf(const tinygltf::Value& extension, const char* key) {
  return extension.Has(key) ? static_cast<std::size_t>(extension.Get(key).GetNumberAsDouble()) : 0;
}

Result<PackedView> packedView(const GltfFile& file, const tinygltf::Value& extension,
                              const std::string& name) {
  const int buffer = extension.Get("buffer").GetNumberAsInt();
  PackedView view{{}, sizeOf(extension, "count"), sizeOf(extension, "byteStride"), {}, "NONE"};
  WEFT_TRY(view.bytes,
           bytesIn(file, buffer, sizeOf(extension, "byteOffset"), sizeOf(extension, "byteLength"), name));
  view.mode = extension.Get("mode").Get<std::string>();
  if (extension.Has("filter")) view.filter = extension.Get("filter").Get<std::string>();
  return view;
}

}  // namespace

#ifdef WEFT_MESHOPTIMIZER
const bool kUnpacksMeshopt = true;
#else
const bool kUnpacksMeshopt = false;
#endif

Result<void> unpackMeshopt(GltfFile& file) {
  constexpr std::size_t kMostFromAByte = 64;  // of vertices that are all alike
  std::size_t unpacked = 0;
  for (std::size_t i = 0; i < file.model.bufferViews.size(); ++i) {
    tinygltf::BufferView& view = file.model.bufferViews[i];
    const auto extension = view.extensions.find(kMeshoptExtension);
    if (extension == view.extensions.end()) continue;
    const std::string name = "buffer view " + std::to_string(i);
    const auto broken = [&](const char* why) {
      return file.fail(name + " " + why + " (" + kMeshoptExtension + ")");
    };
    const auto buffer = static_cast<std::size_t>(view.buffer);
    const bool hasFallback = buffer < file.buffers.size() && !file.buffers[buffer].bytes.empty();
    if (!kUnpacksMeshopt && hasFallback) continue;
    if (!kUnpacksMeshopt) return broken("is packed in a way that this build of Weft cannot unpack");
    WEFT_TRY(const PackedView packed, packedView(file, extension->second, name));
    if (!isValid(packed)) return broken("is packed with a mode, filter or stride that there is not");
    const std::size_t size = packed.count * packed.stride;
    if (size > kMostFromAByte * packed.bytes.size()) return broken("claims more than its bytes can hold");
    unpacked += size;
    WEFT_TRY_VOID(file.checkMemory(unpacked, name));
    std::vector<std::uint8_t> bytes(size);
    if (!unpack(packed, bytes)) return broken("is packed in bytes that are broken");
    view.buffer = file.addBuffer(std::move(bytes));
    view.byteOffset = 0;
    view.byteLength = size;
    view.byteStride = packed.mode == "ATTRIBUTES" ? packed.stride : 0;
  }
  return {};
}

}  // namespace weft
