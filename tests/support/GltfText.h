#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace weft::test {

/// The bytes of numbers one after the other, as a glTF buffer holds them.
class BufferBytes {
 public:
  template <class Number>
  BufferBytes& add(const std::vector<Number>& numbers) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(numbers.data());
    bytes_.insert(bytes_.end(), first, first + numbers.size() * sizeof(Number));
    return *this;
  }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  /// "data:application/octet-stream;base64,..."
  std::string dataUri() const {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text = "data:application/octet-stream;base64,";
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
      std::uint32_t group = 0;
      for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes_.size() ? bytes_[i + k] : 0u);
      for (std::size_t k = 0; k < 4; ++k)
        text += i + k <= bytes_.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// The buffer of planeGltf(): 4 positions, 4 normals, 4 texture coordinates (floats), 6 indices (16
/// bits).
inline BufferBytes planeBuffer() {
  BufferBytes buffer;
  buffer.add<float>({-0.5f, 0.5f, 0, 0.5f, 0.5f, 0, -0.5f, -0.5f, 0, 0.5f, -0.5f, 0})
      .add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})
      .add<float>({0, 0, 1, 0, 0, 1, 1, 1})
      .add<std::uint16_t>({0, 2, 3, 0, 3, 1});
  return buffer;
}

/// The plane of makePlane() with one material, as a .gltf; `bufferUri` empty leaves the uri out,
/// for a .glb. Written without spaces, for replaced().
inline std::string planeGltf(const std::string& material = R"({"name":"base"})",
                             const std::string& bufferUri = planeBuffer().dataUri()) {
  const std::string uri = bufferUri.empty() ? "" : R"("uri":")" + bufferUri + R"(",)";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"plane"}],)"
         R"("meshes":[{"name":"square","primitives":[{"attributes":)"
         R"({"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],)"
         R"("materials":[)" +
         material +
         R"(],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},)"
         R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)"
         R"({"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48},)"
         R"({"buffer":0,"byteOffset":96,"byteLength":32},{"buffer":0,"byteOffset":128,"byteLength":12}],)"
         R"("buffers":[{)" +
         uri + R"("byteLength":140}]})";
}

/// The same as a .glb.
inline std::string planeGlb() {
  std::string json = planeGltf(R"({"name":"base"})", "");
  while (json.size() % 4 != 0) json += ' ';
  const std::vector<std::uint8_t> binary = planeBuffer().bytes();
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" +
         json + word(binary.size()) + std::string("BIN\0", 4) + std::string(binary.begin(), binary.end());
}

/// A .gltf put together from numbers, which become accessors of one embedded buffer.
class GltfText {
 public:
  /// The number of the new accessor; `type`: "VEC3"; `more`: further members of it, each after a
  /// comma.
  template <class Number>
  int add(const std::vector<Number>& numbers, const std::string& type, const std::string& more = "") {
    const std::size_t components = type == "SCALAR" ? 1u
                                   : type == "MAT4" ? 16u
                                                    : static_cast<std::size_t>(type.back() - '0');
    return addAccessor(R"("bufferView":)" + std::to_string(addView(numbers)) + R"(,"componentType":)" +
                       std::to_string(componentType(Number())) + R"(,"count":)" +
                       std::to_string(numbers.size() / components) + R"(,"type":")" + type + '"' + more);
  }

  /// The number of a new accessor with these members.
  int addAccessor(const std::string& members) {
    accessors_ += (accessors_.empty() ? "{" : ",{") + members + "}";
    return accessorCount_++;
  }

  /// The number of a new buffer view.
  template <class Number>
  int addView(const std::vector<Number>& numbers) {
    while (buffer_.bytes().size() % 4 != 0) buffer_.add<std::uint8_t>({0});
    views_ += (views_.empty() ? R"({"buffer":0,"byteOffset":)" : R"(,{"buffer":0,"byteOffset":)") +
              std::to_string(buffer_.bytes().size()) + R"(,"byteLength":)" +
              std::to_string(numbers.size() * sizeof(Number)) + "}";
    buffer_.add(numbers);
    return viewCount_++;
  }

  /// The file; `members` are what it has beside asset, the scene of node 0 and the accessors:
  /// nodes, meshes...
  std::string text(const std::string& members) const {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)" + members +
           R"(,"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
           R"(],"buffers":[{"byteLength":)" + std::to_string(buffer_.bytes().size()) + R"(,"uri":")" +
           buffer_.dataUri() + R"("}]})";
  }

 private:
  static int componentType(std::int8_t) { return 5120; }
  static int componentType(std::uint8_t) { return 5121; }
  static int componentType(std::int16_t) { return 5122; }
  static int componentType(std::uint16_t) { return 5123; }
  static int componentType(std::uint32_t) { return 5125; }
  static int componentType(float) { return 5126; }

  BufferBytes buffer_;
  std::string views_;
  std::string accessors_;
  int viewCount_ = 0;
  int accessorCount_ = 0;
};

/// `text` with the one place that reads `from` changed; throws where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace weft::test
