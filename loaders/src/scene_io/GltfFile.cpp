#include "GltfFile.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

#include "weft/io/FileBytes.h"

namespace weft {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 31;
constexpr int kDeepestJson = 64;

/// How deeply arrays and objects are nested; tinygltf descends by recursion.
int jsonDepth(std::string_view json) {
  int depth = 0, deepest = 0;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString && c == '\\')
      ++i;
    else if (c == '"')
      inString = !inString;
    else if (!inString && (c == '{' || c == '['))
      deepest = std::max(deepest, ++depth);
    else if (!inString && (c == '}' || c == ']'))
      --depth;
  }
  return deepest;
}

bool isBinary(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::uint32_t wordAt(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  std::uint32_t word = 0;  // little-endian, as every machine that GL runs on
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// The JSON text of either kind of file; checks the header of a .glb.
Result<std::string_view> jsonText(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path) {
  const auto text = [&](std::size_t offset, std::size_t size) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, size);
  };
  if (!isBinary(bytes)) return text(0, bytes.size());
  if (bytes.size() < 20) return fail("the file is truncated", path.string());
  if (wordAt(bytes, 4) != 2) return fail("this is not glTF 2.0", path.string());
  const std::size_t length = wordAt(bytes, 8), jsonLength = wordAt(bytes, 12);
  if (length > bytes.size() || jsonLength > bytes.size() - 20)
    return fail("the file is truncated", path.string());
  return text(20, jsonLength);
}

bool isImagePath(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

/// What tinygltf may do with files: read what stands beside the glTF, and nothing else. Its own functions
/// look into the working directory too, and expand paths as a shell would.
tinygltf::FsCallbacks fileAccess(std::string& folder) {
  tinygltf::FsCallbacks access{};
  access.FileExists = [](const std::string& path, void* data) {
    // Images are read later, and only those in use.
    return path.starts_with(*static_cast<std::string*>(data)) && !isImagePath(path) &&
           std::filesystem::is_regular_file(path);
  };
  access.ExpandFilePath = [](const std::string& path, void*) { return path; };
  access.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& path,
                            void*) {
    auto bytes = readFileBytes(path, kLargestFile);
    if (!bytes && error) *error = bytes.error().what;
    if (bytes) *out = std::move(*bytes);
    return bytes.has_value();
  };
  access.WriteWholeFile = nullptr;
  access.user_data = &folder;
  return access;
}

/// Keeps the bytes of an image that is written into the JSON; everything else imageBytes() finds again.
bool keepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

std::string oneLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

std::optional<std::string> unknownRequirement(const tinygltf::Model& model) {
  for (const std::string& extension : model.extensionsRequired)
    if (extension != "KHR_lights_punctual" && extension != "KHR_mesh_quantization" &&
        extension != "WEFT_materials_btf")
      return extension;
  return std::nullopt;
}

std::size_t componentSize(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return 8;
    default:
      return 4;
  }
}

/// Elements of an accessor in its buffer, all of them inside.
struct Elements {
  const std::uint8_t* first;
  std::size_t stride;
  std::size_t count;
  int componentType;
  bool normalized;
};

Result<Elements> elementsOf(const GltfFile& file, int index, std::size_t components) {
  const std::string name = "accessor " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.accessors.size())
    return file.fail(name + " does not exist");
  const tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(index)];
  if (accessor.sparse.isSparse) return file.fail(name + " is sparse, which Weft does not read");
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
      static_cast<int>(components))
    return file.fail(name + " does not have " + std::to_string(components) + " components");
  WEFT_TRY(const std::span<const std::uint8_t> bytes, viewBytes(file, accessor.bufferView));
  const std::size_t size = components * componentSize(accessor.componentType);
  const std::size_t given = file.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  const std::size_t stride = given == 0 ? size : given;
  const bool inside = accessor.count > 0 && accessor.byteOffset <= bytes.size() &&
                      size <= bytes.size() - accessor.byteOffset &&
                      accessor.count - 1 <= (bytes.size() - accessor.byteOffset - size) / stride;
  if (!inside) return file.fail(name + " is empty or reaches beyond its buffer view");
  return Elements{bytes.data() + accessor.byteOffset, stride, accessor.count, accessor.componentType,
                  accessor.normalized};
}

template <class Number>
Number load(const std::uint8_t* bytes) {
  Number value;  // the file need not align it
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class Integer>
float integerToFloat(const std::uint8_t* bytes, bool normalized) {
  const float value = static_cast<float>(load<Integer>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<Integer>::max()), -1.0f);
}

float componentToFloat(const std::uint8_t* bytes, int componentType, bool normalized) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integerToFloat<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integerToFloat<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integerToFloat<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integerToFloat<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return integerToFloat<std::int32_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integerToFloat<std::uint32_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return static_cast<float>(load<double>(bytes));
    default:
      return load<float>(bytes);
  }
}

}  // namespace

Result<GltfFile> readGltfFile(const std::filesystem::path& path) {
  WEFT_TRY(std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestFile));
  WEFT_TRY(const std::string_view json, jsonText(bytes, path));
  if (jsonDepth(json) > kDeepestJson) return fail("the JSON is nested too deeply", path.string());
  const auto size = static_cast<unsigned int>(bytes.size());
  // tinygltf's check of the second chunk of a .glb reads 8 bytes beyond the end of a truncated file.
  bytes.resize(bytes.size() + 8);

  GltfFile file{path, {}};
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keepImageBytes, nullptr);
  std::error_code ignored;
  std::string folder = std::filesystem::absolute(path, ignored).parent_path().string();
  parser.SetFsCallbacks(fileAccess(folder));
  std::string error, warning;
  try {
    const bool parsed =
        isBinary(bytes)
            ? parser.LoadBinaryFromMemory(&file.model, &error, &warning, bytes.data(), size, folder)
            : parser.LoadASCIIFromString(&file.model, &error, &warning,
                                         reinterpret_cast<const char*>(bytes.data()), size, folder);
    if (!parsed) return file.fail("this is not valid glTF: " + oneLine(error));
  } catch (const std::exception& exception) {
    return file.fail(std::string("this is not valid glTF: ") + exception.what());
  }
  if (const auto extension = unknownRequirement(file.model))
    return file.fail("the file requires the extension " + *extension + ", which Weft does not know");
  return file;
}

Result<std::span<const std::uint8_t>> viewBytes(const GltfFile& file, int index) {
  const std::string name = "buffer view " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.bufferViews.size())
    return file.fail(name + " does not exist");
  const tinygltf::BufferView& view = file.model.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= file.model.buffers.size())
    return file.fail(name + " names a buffer that does not exist");
  const std::vector<unsigned char>& data = file.model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return file.fail(name + " reaches beyond its buffer");
  return std::span<const std::uint8_t>(data).subspan(view.byteOffset, view.byteLength);
}

Result<std::vector<float>> readFloats(const GltfFile& file, int accessor, std::size_t components) {
  WEFT_TRY(const Elements elements, elementsOf(file, accessor, components));
  const std::size_t size = componentSize(elements.componentType);
  std::vector<float> values;
  values.reserve(elements.count * components);
  for (std::size_t i = 0; i < elements.count; ++i)
    for (std::size_t k = 0; k < components; ++k) {
      const float value = componentToFloat(elements.first + i * elements.stride + k * size,
                                           elements.componentType, elements.normalized);
      if (!std::isfinite(value))
        return file.fail("accessor " + std::to_string(accessor) + " holds a value that is not finite");
      values.push_back(value);
    }
  return values;
}

Result<std::vector<std::uint32_t>> readIndices(const GltfFile& file, int accessor) {
  WEFT_TRY(const Elements elements, elementsOf(file, accessor, 1));
  std::vector<std::uint32_t> indices;
  indices.reserve(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i) {
    const std::uint8_t* bytes = elements.first + i * elements.stride;
    switch (elements.componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        indices.push_back(*bytes);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        indices.push_back(load<std::uint16_t>(bytes));
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        indices.push_back(load<std::uint32_t>(bytes));
        break;
      default:
        return file.fail("accessor " + std::to_string(accessor) + " does not hold unsigned integers");
    }
  }
  return indices;
}

Result<std::vector<std::uint8_t>> imageBytes(const GltfFile& file, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.images.size())
    return file.fail("image " + std::to_string(index) + " does not exist");
  const tinygltf::Image& image = file.model.images[static_cast<std::size_t>(index)];
  if (image.bufferView >= 0) {
    WEFT_TRY(const std::span<const std::uint8_t> bytes, viewBytes(file, image.bufferView));
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  }
  if (!image.image.empty()) return image.image;
  if (image.uri.empty()) return file.fail("image " + std::to_string(index) + " is empty");
  return readFileBytes(resolve(file, image.uri), kLargestImageFile);
}

std::filesystem::path resolve(const GltfFile& file, const std::string& uri) {
  std::string decoded;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char code = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3) {
      decoded.push_back(static_cast<char>(code));
      i += 2;
    } else {
      decoded.push_back(uri[i]);
    }
  }
  return file.folder() / decoded;
}

}  // namespace weft
