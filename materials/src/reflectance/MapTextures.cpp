#include "weft/reflectance/MapTextures.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "weft/core/Color.h"
#include "weft/reflectance/BoxAverages.h"
#include "weft/reflectance/FieldTextures.h"

namespace weft {
namespace {

// Some directions of a list, spread over it.
std::vector<int> someOf(std::size_t count) {
  constexpr std::size_t kMost = 8;
  std::vector<int> some;
  for (std::size_t i = 0; i < std::min(count, kMost); ++i)
    some.push_back(static_cast<int>(i * count / std::min(count, kMost)));
  return some;
}

// How bright texels are beside their base colours, on average over some views and lights: what base
// colours are weighted by where texels become one.
class Brightness {
 public:
  explicit Brightness(const ReflectanceField& field)
      : field_(field), views_(someOf(field.description().views.size())) {
    std::vector<glm::vec3> lights;
    for (const int light : someOf(field.description().lights.size()))
      lights.push_back(field.description().lights[static_cast<std::size_t>(light)]);
    lights_ = field.formula().modelledLights(lights);
  }

  float of(std::span<const float> shared) const {
    std::vector<glm::vec3> values(lights_.directions.size());
    float sum = 0.0f;
    for (const int view : views_) {
      const glm::vec3 direction = field_.description().views[static_cast<std::size_t>(view)];
      field_.formula().evaluateLights(shared, {}, view, lights_, direction, values);
      for (const glm::vec3& value : values) sum += luminance(value);
    }
    constexpr float kDark = 1e-6f;  // where all is black all texels count alike
    return sum / std::max(luminance({shared[0], shared[1], shared[2]}), kDark) + kDark;
  }

 private:
  const ReflectanceField& field_;
  std::vector<int> views_;
  ModelledLights lights_;
};

// The shared numbers of all texels as they may be averaged: base colours times a brightness, which
// comes last.
FloatImage weighedTexels(const ReflectanceField& field) {
  std::vector<std::string> channels = field.shared().channels();
  channels.emplace_back("brightness");
  FloatImage weighed(field.width(), field.height(), channels);
  const Brightness brightness(field);
  tbb::parallel_for(0, field.height(), [&](int y) {
    for (int x = 0; x < field.width(); ++x) {
      const std::span<const float> from = field.shared().texel(x, y);
      const std::span<float> to = weighed.texel(x, y);
      std::ranges::copy(from, to.begin());
      to.back() = brightness.of(from);
      for (std::size_t c = 0; c < 3; ++c) to[c] *= to.back();
    }
  });
  return weighed;
}

FieldLevel levelFrom(const std::vector<float>& weighed, glm::ivec2 size,
                     const std::vector<std::string>& channels) {
  FieldLevel level{FloatImage(size.x, size.y, channels), {}};
  const std::size_t numbers = channels.size() + 1;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::size_t index =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
      const float* from = weighed.data() + index * numbers;
      const std::span<float> to = level.shared.texel(x, y);
      std::copy_n(from, channels.size(), to.begin());
      for (std::size_t c = 0; c < 3; ++c) to[c] /= from[channels.size()];
    }
  return level;
}

}  // namespace

TextureImage packCoordinates(const CoordinateMap& map) {
  constexpr int kByteValues = 256;
  const bool isSmall = map.sampleWidth() <= kByteValues && map.sampleHeight() <= kByteValues;
  TextureImage packed(map.width(), map.height(), 1, 2, isSmall ? TexelType::WholeByte : TexelType::WholeWord);
  tbb::parallel_for(0, map.height(), [&](int y) {
    for (int x = 0; x < map.width(); ++x) {
      const glm::vec2 texel = map.at(x, y);
      packed.set(x, y, 0, 0, std::array{texel.x, texel.y});
    }
  });
  return packed;
}

std::vector<FieldLevel> mappedLevels(const ReflectanceField& field, const CoordinateMap& map) {
  const FloatImage texels = weighedTexels(field);
  const auto numbers = static_cast<std::size_t>(texels.channelCount());
  glm::ivec2 fine(map.width(), map.height());
  std::vector<float> averages;
  std::function<const float*(int, int)> texelAt = [&](int x, int y) {
    const glm::ivec2 texel = map.at(x, y);
    return texels.texel(texel.x, texel.y).data();
  };
  std::vector<FieldLevel> levels;
  for (const FieldLevel& level : field.levels()) {
    const glm::ivec2 size(level.shared.width(), level.shared.height());
    averages = boxAverages(fine, size, numbers, texelAt);
    levels.push_back(levelFrom(averages, size, field.shared().channels()));
    fine = size;
    texelAt = [&](int x, int y) {
      return averages.data() +
             (static_cast<std::size_t>(y) * static_cast<std::size_t>(fine.x) + static_cast<std::size_t>(x)) *
                 numbers;
    };
  }
  return levels;
}

Result<void> checkMapFits(const CoordinateMap& map, glm::ivec2 fieldSize) {
  if (map.sampleWidth() == fieldSize.x && map.sampleHeight() == fieldSize.y) return {};
  const std::string of = map.sampleName().empty() ? std::string() : " of " + map.sampleName();
  return fail(fmt::format("the coordinate map is for a sample{} of {} x {} texels, the reflectance field has "
                          "{} x {}",
                          of, map.sampleWidth(), map.sampleHeight(), fieldSize.x, fieldSize.y),
              {}, "make a map for this field");
}

}  // namespace weft
