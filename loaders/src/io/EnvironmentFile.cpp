#include "weft/io/EnvironmentFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "weft/core/AtomicFile.h"
#include "weft/io/ExrFile.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

// Another one whenever PrefilteredEnvironment::create() makes something else of the same picture.
constexpr std::string_view kMagic = "weft environment 1\n";

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

/// FNV-1a over whole words, twice with different starts: 128 bits against chance, not against malice.
std::string contentHash(const FloatImage& image) {
  std::array<std::uint64_t, 2> hash{0xcbf29ce484222325u, 0x84222325cbf29ce4u};
  const auto add = [&](std::uint64_t word) {
    for (std::uint64_t& each : hash) {
      each = (each ^ word) * 0x100000001b3u;
      each ^= each >> 29;
    }
  };
  add(static_cast<std::uint64_t>(image.width()));
  add(static_cast<std::uint64_t>(image.height()));
  const auto values = image.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t bits;
    std::memcpy(&bits, &values[i], sizeof bits);
    add(bits);
  }
  return fmt::format("{:016x}{:016x}", hash[0], hash[1]);
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

std::size_t cacheBytes(const PrefilteredEnvironment& prefiltered) {
  return kMagic.size() + sizeof(float) +
         sizeof(std::uint16_t) * (prefiltered.lobes.values().size() + prefiltered.moments.values().size() +
                                  prefiltered.glossy.values().size());
}

std::string packed(PrefilteredEnvironment& prefiltered) {
  std::string bytes(kMagic);
  bytes.reserve(cacheBytes(prefiltered));
  bytes.append(reinterpret_cast<const char*>(&prefiltered.scale), sizeof(float));
  std::vector<std::uint16_t> halfs;
  for (const FloatImage* image : imagesOf(prefiltered)) {
    halfs.clear();
    for (const float value : image->values()) halfs.push_back(halfBits(value));
    bytes.append(reinterpret_cast<const char*>(halfs.data()), halfs.size() * sizeof(std::uint16_t));
  }
  return bytes;
}

/// False where the bytes are not those of a prefiltered environment.
bool unpack(std::span<const std::uint8_t> bytes, PrefilteredEnvironment& prefiltered) {
  if (bytes.size() != cacheBytes(prefiltered) || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    return false;
  const std::uint8_t* next = bytes.data() + kMagic.size();
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

bool isRadiance(std::span<const std::uint8_t> bytes) {
  return bytes.size() > 2 && bytes[0] == '#' && bytes[1] == '?';
}

Result<FloatImage> readPicture(const std::filesystem::path& path) {
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestImageFile));
  if (isRadiance(bytes)) return decodeRadiance(bytes, path.string());
  constexpr std::array<std::uint8_t, 4> kExr{0x76, 0x2f, 0x31, 0x01};
  if (bytes.size() < 4 || !std::equal(kExr.begin(), kExr.end(), bytes.begin()))
    return fail("this is neither a Radiance (.hdr) nor an OpenEXR picture", path.string());
  return readExr(path);
}

}  // namespace

Result<Environment> readEnvironment(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  WEFT_TRY(const FloatImage picture, readPicture(path));
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

PrefilteredEnvironment prefilter(const Environment& environment, const std::filesystem::path& folder) {
  if (folder.empty()) return PrefilteredEnvironment::create(environment);
  const std::filesystem::path file = folder / (contentHash(environment.image()) + ".env");
  PrefilteredEnvironment prefiltered = emptyEnvironment();
  if (const auto bytes = readFileBytes(file, cacheBytes(prefiltered)); bytes && unpack(*bytes, prefiltered))
    return prefiltered;
  prefiltered = PrefilteredEnvironment::create(environment);
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  (void)writeWholeFile(file, packed(prefiltered));  // without it the next run takes longer
  return prefiltered;
}

Result<Environment> environmentNamed(const std::string& nameOrFile, std::vector<std::string>& warnings) {
  const std::vector<std::string> names = Environment::builtinNames();
  const bool builtin = std::find(names.begin(), names.end(), nameOrFile) != names.end();
  return builtin ? Environment::builtin(nameOrFile) : readEnvironment(nameOrFile, warnings);
}

}  // namespace weft
