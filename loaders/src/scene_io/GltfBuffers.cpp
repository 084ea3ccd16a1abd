#include "GltfBuffers.h"

#include <map>
#include <nlohmann/json.hpp>

#include "GltfReference.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

/// Whether a buffer only takes the place of one for programs that cannot unpack
/// (EXT_meshopt_compression).
bool isPlaceholder(const Json& buffer) {
  return buffer.value(Json::json_pointer("/extensions/EXT_meshopt_compression/fallback"), false);
}

/// The bytes of files, each read once.
class BufferFiles {
 public:
  explicit BufferFiles(const std::filesystem::path& file) : file_(file) {}

  Result<GltfBuffer> get(const std::string& uri) {
    std::string key = "data:";
    if (!isDataUri(uri)) {
      WEFT_TRY(const std::filesystem::path path, resolveUri(file_, uri));
      key = path.lexically_normal().string();
    }
    Bytes& bytes = read_[key];
    if (!bytes || key == "data:") {
      WEFT_TRY(std::vector<std::uint8_t> own, readUri(file_, uri, kLargestGltfFile));
      bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(own));
    }
    return GltfBuffer{bytes, *bytes};
  }

 private:
  const std::filesystem::path& file_;
  std::map<std::string, Bytes> read_;
};

/// Says what the missing or broken file is for.
tl::unexpected<Error> becauseOf(Error error, const GltfFile& file, const std::string& name) {
  const std::string hint = "it is " + name + " of " + file.path.filename().string();
  error.hint = error.hint.empty() ? hint : hint + "; " + error.hint;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace

Result<void> readBuffers(const Json& root, const GltfBuffer& binary, GltfFile& file) {
  BufferFiles files(file.path);
  const Json none = Json::array();
  const auto found = root.find("buffers");
  for (const Json& source : found == root.end() ? none : *found) {
    const std::string name = "/buffers/" + std::to_string(file.buffers.size());
    const auto uri = source.find("uri");
    GltfBuffer& buffer = file.buffers.emplace_back();
    if (uri == source.end() && isPlaceholder(source)) continue;
    if (uri != source.end()) {
      auto read = files.get(uri->get_ref<const std::string&>());
      if (!read) return becauseOf(std::move(read).error(), file, name);
      buffer = *read;
    } else if (file.buffers.size() == 1) {
      buffer = binary;
    }
    if (uri == source.end() && buffer.bytes.empty()) return file.fail(name + " has neither uri nor bytes");
    const auto length = source["byteLength"].get<std::size_t>();
    if (buffer.bytes.size() < length)
      return file.fail("this is not valid glTF: " + name + " has " + std::to_string(length) +
                       " bytes, of which " + std::to_string(buffer.bytes.size()) + " are there");
    buffer.bytes = buffer.bytes.first(length);
  }
  return {};
}

}  // namespace weft
