#include "weft/io/EnvironmentFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "weft/core/AtomicFile.h"
#include "weft/io/FileBytes.h"
#include "weft/io/PictureFile.h"

namespace weft {
namespace {

// Another number whenever PrefilteredEnvironment::create() makes something else of the same
// picture, or files hold it otherwise.
constexpr std::string_view kMagic = "weft environment 2\n";
constexpr std::string_view kExtension = ".2.env";

using Images = std::array<FloatImage*, 3>;

Images imagesOf(PrefilteredEnvironment& prefiltered) {
  return {&prefiltered.lobes, &prefiltered.moments, &prefiltered.glossy};
}

/// The images of every prefiltered environment, without values.
PrefilteredEnvironment emptyEnvironment() {
  using P = PrefilteredEnvironment;
  const auto image = [](OctahedralMap map, int layers) {
    return FloatImage(map.imageSize(), map.imageSize(), {"R", "G", "B"}, layers);
  };
  return {image(P::kLobeMap, P::kLobeLayers), image(P::kLobeMap, P::kMomentLayers),
          image(P::kGlossyMap, P::kGlossyLayers), 1.0f};
}

/// FNV-1a over whole words, twice with different starts: 128 bits against chance, not against
/// malice.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (std::uint64_t& each : words_) {
      each = (each ^ word) * 0x100000001b3u;
      each ^= each >> 29;
    }
  }
  std::string text() const { return fmt::format("{:016x}{:016x}", words_[0], words_[1]); }

 private:
  std::array<std::uint64_t, 2> words_{0xcbf29ce484222325u, 0x84222325cbf29ce4u};
};
constexpr std::size_t kHashCharacters = 32;

std::string contentHash(const FloatImage& image) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(image.width()));
  hash.add(static_cast<std::uint64_t>(image.height()));
  const auto values = image.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t bits;
    std::memcpy(&bits, &values[i], sizeof bits);
    hash.add(bits);
  }
  return hash.text();
}

std::string checksumOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes.size());
  for (; !bytes.empty(); bytes.remove_prefix(std::min(sizeof(std::uint64_t), bytes.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min(sizeof word, bytes.size()));
    hash.add(word);
  }
  return hash.text();
}

/// A finite half that is stored as 16 bits; FloatImage promises that all values are such.
std::uint16_t halfBits(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  const std::uint32_t sign = bits >> 16 & 0x8000u;
  const float magnitude = std::abs(value);
  if (magnitude < 0x1p-14f)
    return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(magnitude * 0x1p24f));
  return static_cast<std::uint16_t>(sign | (((bits & 0x7fffffffu) - 0x38000000u) >> 13));
}

float floatOf(std::uint16_t half) {
  const float sign = half & 0x8000u ? -1.0f : 1.0f;
  const std::uint32_t magnitude = half & 0x7fffu;
  if (magnitude < 0x400u) return sign * static_cast<float>(magnitude) * 0x1p-24f;
  const std::uint32_t bits = (magnitude << 13) + 0x38000000u;
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return sign * value;
}

/// Scale and values as a file holds them.
std::size_t valueBytes(const PrefilteredEnvironment& prefiltered) {
  return sizeof(float) +
         sizeof(std::uint16_t) * (prefiltered.lobes.values().size() + prefiltered.moments.values().size() +
                                  prefiltered.glossy.values().size());
}

/// What a file begins with: it is of this picture, and its values are as they were written.
std::string headOf(const std::string& picture, std::string_view values) {
  return std::string(kMagic) + picture + checksumOf(values);
}
constexpr std::size_t kHeadBytes = kMagic.size() + 2 * kHashCharacters;

std::string packed(PrefilteredEnvironment& prefiltered) {
  std::string bytes;
  bytes.reserve(valueBytes(prefiltered));
  bytes.append(reinterpret_cast<const char*>(&prefiltered.scale), sizeof(float));
  std::vector<std::uint16_t> halfs;
  for (const FloatImage* image : imagesOf(prefiltered)) {
    halfs.clear();
    for (const float value : image->values()) halfs.push_back(halfBits(value));
    bytes.append(reinterpret_cast<const char*>(halfs.data()), halfs.size() * sizeof(std::uint16_t));
  }
  return bytes;
}

/// False where the values, as many as there must be, are not those of a prefiltered environment.
bool unpack(const char* next, PrefilteredEnvironment& prefiltered) {
  std::memcpy(&prefiltered.scale, next, sizeof(float));
  next += sizeof(float);
  if (!(prefiltered.scale >= 1.0f && prefiltered.scale <= Environment::kBrightest)) return false;
  for (FloatImage* image : imagesOf(prefiltered)) {
    for (float& value : image->values()) {
      std::uint16_t half;
      std::memcpy(&half, next, sizeof half);
      next += sizeof half;
      if ((half & 0x7c00u) == 0x7c00u) return false;  // infinite or none
      value = floatOf(half);
    }
    image->setPrecision(Precision::Half);
  }
  return true;
}

/// What a file keeps of a picture; fails where it is not as it was written.
Result<PrefilteredEnvironment> readKept(const std::filesystem::path& file, const std::string& picture) {
  PrefilteredEnvironment prefiltered = emptyEnvironment();
  const std::size_t size = kHeadBytes + valueBytes(prefiltered);
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(file, size));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.size() != size || !text.starts_with(headOf(picture, text.substr(kHeadBytes))) ||
      !unpack(text.data() + kHeadBytes, prefiltered))
    return fail("the prefiltered environment is damaged", file.string());
  return prefiltered;
}

}  // namespace

Result<Environment> readEnvironment(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  WEFT_TRY(const FloatImage picture, readLinearPicture(path, warnings));
  auto environment = Environment::create(picture, warnings);
  if (!environment) return fail(environment.error().what, path.string(), environment.error().hint);
  return environment;
}

std::filesystem::path cacheFolder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "weft";
  if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "weft";
  return {};
}

PrefilteredEnvironment prefilter(const Environment& environment, const std::filesystem::path& folder,
                                 std::vector<std::string>& warnings) {
  if (folder.empty()) return PrefilteredEnvironment::create(environment);
  const std::string picture = contentHash(environment.image());
  const std::filesystem::path file = folder / (picture + std::string(kExtension));
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    Result<PrefilteredEnvironment> kept = readKept(file, picture);
    if (kept) return std::move(*kept);
    warnings.push_back(kept.error().message() + "; it is made anew");
  }
  PrefilteredEnvironment prefiltered = PrefilteredEnvironment::create(environment);
  const std::string values = packed(prefiltered);
  std::filesystem::create_directories(folder, ignored);
  // without it the next run takes longer
  (void)writeWholeFile(file, headOf(picture, values) + values);
  return prefiltered;
}

Result<Environment> environmentNamed(const std::string& nameOrFile, std::vector<std::string>& warnings) {
  const std::vector<std::string> names = Environment::builtinNames();
  if (std::ranges::find(names, nameOrFile) != names.end()) return Environment::builtin(nameOrFile);
  std::error_code ignored;
  if (std::filesystem::status(nameOrFile, ignored).type() == std::filesystem::file_type::not_found)
    return fail("no such file, nor a built-in environment", nameOrFile,
                fmt::format("built in are {}", fmt::join(names, " and ")));
  return readEnvironment(nameOrFile, warnings);
}

}  // namespace weft
