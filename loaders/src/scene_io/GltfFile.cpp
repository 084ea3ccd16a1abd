#include "GltfFile.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>

#include "GltfBuffers.h"
#include "GltfContainer.h"
#include "GltfDraco.h"
#include "GltfMeshopt.h"
#include "GltfReference.h"
#include "GltfShape.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

// Meshes take 4 to 50 bytes for each of their file (indices of triangles without normals most),
// packed ones up to hundreds.
constexpr std::size_t kFreeMemory = std::size_t{64} << 20;
constexpr std::size_t kMemoryPerByte = 128, kMemoryPerPackedByte = 1024;

std::string oneLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

/// "2.0" as 2 and 0.
std::pair<int, int> versionFrom(const std::string& text) {
  std::pair<int, int> version{-1, 0};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, version.first);
  if (error == std::errc() && rest != end && *rest == '.') std::from_chars(rest + 1, end, version.second);
  return version;
}

/// Whether Weft reads this version of glTF; a later 2.x, too, unless it says that 2.0 will not do.
Result<void> checkVersion(const GltfFile& file) {
  const auto& [version, minimum] = std::pair(file.contents.version, file.contents.minVersion);
  if (!version.empty() && versionFrom(version).first != 2)
    return file.fail("this is glTF " + version + ", not 2.0");
  if (!minimum.empty() && versionFrom(minimum) > std::pair(2, 0))
    return file.fail("this needs glTF " + minimum + " (asset.minVersion), and Weft reads 2.0");
  return {};
}

/// Fails where the file needs an extension that nobody knows.
Result<void> checkRequirements(const GltfFile& file, const GltfOptions& options) {
  std::string names;
  for (const std::string& extension : file.contents.required)
    if (!isKnownExtension(extension) && !options.extensions.contains(extension))
      names += (names.empty() ? "" : ", ") + extension;
  if (names.empty()) return {};
  return file.fail("the file requires extensions that Weft does not know: " + names);
}

/// Leaves tinygltf what it does well: no buffers, which it refuses when they are longer than they
/// say, and no images.
Result<void> parseModel(Json root, GltfFile& file) {
  root.erase("buffers");
  root.erase("images");
  // It refuses indices without a buffer view, which are zeros or packed: it is shown one.
  std::vector<std::size_t> bare;
  if (const auto accessors = root.find("accessors"); accessors != root.end())
    for (std::size_t i = 0; i < accessors->size(); ++i)
      if (!(*accessors)[i].contains("bufferView")) bare.push_back(i);
  Json& views = root["bufferViews"];
  for (const std::size_t accessor : bare) root["accessors"][accessor]["bufferView"] = views.size();
  views.push_back({{"buffer", 0}, {"byteLength", 0}});

  const std::string text = root.dump();
  tinygltf::TinyGLTF parser;
  std::string error, warning;
  try {
    if (!parser.LoadASCIIFromString(&file.model, &error, &warning, text.c_str(),
                                    static_cast<unsigned int>(text.size()), ""))
      return file.fail("this is not valid glTF: " + oneLine(error));
  } catch (const std::exception& exception) {
    return file.fail(std::string("this is not valid glTF: ") + exception.what());
  }
  file.model.bufferViews.pop_back();
  for (const std::size_t accessor : bare) file.model.accessors[accessor].bufferView = -1;
  return {};
}

void listFiles(const Json& value, GltfFile& file) {
  if (value.is_object())
    for (const char* name : {"uri", "map"})
      if (const auto uri = value.find(name); uri != value.end() && uri->is_string())
        if (auto path = resolveUri(file.path, uri->get_ref<const std::string&>()))
          file.namedFiles.push_back(std::move(*path));
  if (value.is_structured())
    for (const Json& member : value) listFiles(member, file);
}

void listImages(const Json& root, GltfFile& file) {
  const auto images = root.find("images");
  for (std::size_t i = 0; images != root.end() && i < images->size(); ++i) {
    tinygltf::Image& image = file.model.images.emplace_back();
    image.uri = (*images)[i].value("uri", "");
    image.bufferView = (*images)[i].value("bufferView", -1);
  }
}

bool isPacked(const GltfFile& file) {
  const auto& used = file.model.extensionsUsed;
  return std::any_of(used.begin(), used.end(), [](const std::string& name) {
    return name == kDracoExtension || name == kMeshoptExtension;
  });
}

std::size_t memoryLimitOf(const GltfFile& file, std::size_t fileSize) {
  std::map<const void*, std::size_t> owners;
  for (const GltfBuffer& buffer : file.buffers)
    if (buffer.owner) owners[buffer.owner.get()] = buffer.owner->size();
  std::size_t bytes = fileSize;
  for (const auto& [owner, size] : owners) bytes += size;
  return kFreeMemory + (isPacked(file) ? kMemoryPerPackedByte : kMemoryPerByte) * bytes;
}

}  // namespace

Result<void> GltfFile::checkMemory(std::size_t bytes, const std::string& what) const {
  if (bytes <= memoryLimit) return {};
  return fail(what + " would take " + std::to_string(bytes >> 20) + " MB, more than the " +
              std::to_string(memoryLimit >> 20) + " MB that a file of this size may take");
}

int GltfFile::addBuffer(std::vector<std::uint8_t> bytes) {
  const auto owner = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  buffers.push_back({owner, *owner});
  return static_cast<int>(buffers.size()) - 1;
}

Result<GltfFile> readGltfFile(const std::filesystem::path& path, const GltfOptions& options) {
  WEFT_TRY(std::vector<std::uint8_t> read, readGltfBytes(path));
  const auto bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(read));
  WEFT_TRY(const GltfContainer container, containerOf(*bytes, path));
  WEFT_TRY(Json root, parseJson(container, path));
  GltfFile file{path, {}, {}, contentsOf(root), {}, {}, 0};
  WEFT_TRY_VOID(checkVersion(file));
  WEFT_TRY_VOID(checkRequirements(file, options));
  WEFT_TRY_VOID(checkShape(root, path, file.warnings));
  WEFT_TRY_VOID(readBuffers(root, {bytes, container.binary}, file));
  listFiles(root, file);
  listImages(root, file);
  WEFT_TRY_VOID(parseModel(std::move(root), file));
  file.memoryLimit = memoryLimitOf(file, bytes->size());
  WEFT_TRY_VOID(unpackMeshopt(file));
  WEFT_TRY_VOID(unpackDraco(file));
  return file;
}

Result<std::span<const std::uint8_t>> viewBytes(const GltfFile& file, int index) {
  const std::string name = "buffer view " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.bufferViews.size())
    return file.fail(name + " does not exist");
  const tinygltf::BufferView& view = file.model.bufferViews[static_cast<std::size_t>(index)];
  return bytesIn(file, view.buffer, view.byteOffset, view.byteLength, name);
}

Result<std::span<const std::uint8_t>> bytesIn(const GltfFile& file, int buffer, std::size_t offset,
                                              std::size_t length, const std::string& name) {
  if (buffer < 0 || static_cast<std::size_t>(buffer) >= file.buffers.size())
    return file.fail(name + " names a buffer that does not exist");
  const std::span<const std::uint8_t> bytes = file.buffers[static_cast<std::size_t>(buffer)].bytes;
  if (offset > bytes.size() || length > bytes.size() - offset)
    return file.fail(name + " reaches beyond its buffer");
  return bytes.subspan(offset, length);
}

Result<std::vector<double>> numbersOf(const GltfFile& file, const std::string& extension,
                                      const tinygltf::Value& value, const std::string& key,
                                      const std::vector<double>& otherwise) {
  if (!value.IsObject()) return file.fail(extension + " is not an object");
  if (!value.Has(key)) return otherwise;
  const tinygltf::Value& member = value.Get(key);
  std::vector<double> numbers;
  if (otherwise.size() == 1 && member.IsNumber()) numbers.push_back(member.GetNumberAsDouble());
  for (std::size_t i = 0; otherwise.size() > 1 && i < member.ArrayLen(); ++i) {
    const tinygltf::Value& element = member.Get(static_cast<int>(i));
    if (element.IsNumber()) numbers.push_back(element.GetNumberAsDouble());
  }
  const bool finite = std::all_of(numbers.begin(), numbers.end(),
                                  [](double number) { return std::isfinite(static_cast<float>(number)); });
  if (!finite || numbers.size() != otherwise.size() ||
      (member.IsArray() && member.ArrayLen() != numbers.size()))
    return file.fail("the " + key + " of " + extension + " is not " +
                     (otherwise.size() == 1 ? "a number" : std::to_string(otherwise.size()) + " numbers"));
  return numbers;
}

Result<std::vector<std::uint8_t>> imageBytes(const GltfFile& file, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.images.size())
    return file.fail("image " + std::to_string(index) + " does not exist");
  const tinygltf::Image& image = file.model.images[static_cast<std::size_t>(index)];
  if (image.bufferView >= 0) {
    WEFT_TRY(const std::span<const std::uint8_t> bytes, viewBytes(file, image.bufferView));
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  }
  if (image.uri.empty()) return file.fail("image " + std::to_string(index) + " is empty");
  return readUri(file.path, image.uri, kLargestImageFile);
}

}  // namespace weft
