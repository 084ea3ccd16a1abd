#include "GltfContainer.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "GltfReference.h"
#include "weft/core/FileKind.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

constexpr int kDeepestJson = 64;
constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;

/// How deeply arrays and objects are nested.
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

bool isObject(std::string_view json) {
  if (json.starts_with("\xEF\xBB\xBF")) json.remove_prefix(3);
  const std::size_t first = json.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && json[first] == '{';
}

std::uint32_t wordAt(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t word = 0;  // little-endian, as every machine that GL runs on
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

std::string_view textOf(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The chunks of a .glb; others than the text and the buffer are an extension's.
Result<GltfContainer> chunksOf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  const auto truncated = [&] { return fail("the file is truncated", path.string()); };
  if (bytes.size() < kHeaderSize) return truncated();
  if (wordAt(bytes, 4) != 2) return fail("this is not glTF 2.0", path.string());
  if (wordAt(bytes, 8) > bytes.size()) return truncated();
  bytes = bytes.first(wordAt(bytes, 8));
  if (bytes.size() < kHeaderSize + kChunkHeaderSize) return truncated();
  GltfContainer container;
  for (bytes = bytes.subspan(kHeaderSize); bytes.size() >= kChunkHeaderSize;) {
    const std::size_t size = wordAt(bytes, 0);
    if (size > bytes.size() - kChunkHeaderSize) return truncated();
    const std::string_view kind = textOf(bytes.subspan(4, 4));
    const std::span<const std::uint8_t> content = bytes.subspan(kChunkHeaderSize, size);
    if (kind == "JSON" && container.json.empty()) container.json = textOf(content);
    if (kind == std::string_view("BIN\0", 4) && container.binary.empty()) container.binary = content;
    bytes = bytes.subspan(kChunkHeaderSize + size);
  }
  return container;
}

}  // namespace

Result<std::vector<std::uint8_t>> readGltfBytes(const std::filesystem::path& path) {
  return readFileBytes(path, kLargestGltfFile);
}

Result<GltfContainer> containerOf(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path) {
  GltfContainer container{textOf(bytes)};
  if (container.json.starts_with("glTF")) {
    WEFT_TRY(container, chunksOf(bytes, path));
  }
  if (!isObject(container.json)) return failOtherKind(fileKind(bytes), "valid glTF", path.string());
  if (jsonDepth(container.json) > kDeepestJson) return fail("the JSON is nested too deeply", path.string());
  return container;
}

Result<nlohmann::ordered_json> parseJson(const GltfContainer& container, const std::filesystem::path& path) {
  using Json = nlohmann::ordered_json;
  try {
    return Json::parse(container.json);
  } catch (const Json::parse_error& error) {
    return fail("this is not valid glTF: its JSON is broken at byte " + std::to_string(error.byte),
                path.string());
  } catch (const Json::exception&) {
    return fail("this is not valid glTF: its JSON has a number beyond all bounds", path.string());
  }
}

}  // namespace weft
