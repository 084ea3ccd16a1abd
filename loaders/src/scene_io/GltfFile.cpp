#include "GltfFile.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
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

/// The names of required extensions that nobody knows, as a list; empty without any.
std::string unknownRequirements(const GltfContents& contents, const GltfOptions& options) {
  std::string names;
  for (const std::string& extension : contents.required)
    if (!isKnownExtension(extension) && !options.extensions.contains(extension))
      names += (names.empty() ? "" : ", ") + extension;
  return names;
}

}  // namespace

Result<std::vector<std::uint8_t>> readGltfBytes(const std::filesystem::path& path) {
  return readFileBytes(path, kLargestFile);
}

Result<std::string_view> jsonOf(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path) {
  std::string_view json(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (isBinary(bytes)) {
    if (bytes.size() < 20) return fail("the file is truncated", path.string());
    if (wordAt(bytes, 4) != 2) return fail("this is not glTF 2.0", path.string());
    const std::size_t length = wordAt(bytes, 8), jsonLength = wordAt(bytes, 12);
    if (length > bytes.size() || jsonLength > bytes.size() - 20)
      return fail("the file is truncated", path.string());
    json = json.substr(20, jsonLength);
  }
  if (jsonDepth(json) > kDeepestJson) return fail("the JSON is nested too deeply", path.string());
  return json;
}

Result<GltfFile> readGltfFile(const std::filesystem::path& path, const GltfOptions& options) {
  WEFT_TRY(std::vector<std::uint8_t> bytes, readGltfBytes(path));
  WEFT_TRY(const std::string_view json, jsonOf(bytes, path));
  GltfFile file{path, {}, contentsOf(json), {}};
  if (file.contents.version.starts_with("1.") || file.contents.version.starts_with("0."))
    return file.fail("this is glTF " + file.contents.version + ", not 2.0");
  if (const std::string names = unknownRequirements(file.contents, options); !names.empty())
    return file.fail("the file requires extensions that Weft does not know: " + names);

  const auto size = static_cast<unsigned int>(bytes.size());
  // tinygltf's check of the second chunk of a .glb reads 8 bytes beyond the end of a truncated file.
  bytes.resize(bytes.size() + 8);
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
  file.warning = oneLine(error);
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
