#include "weft/reflectance/Environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

FloatImage emptyImage(int width, int height) {
  return FloatImage(width, height, {"R", "G", "B"});
}

std::optional<std::array<int, 3>> colorChannels(const FloatImage& image) {
  if (image.channelCount() == 1) return std::array{0, 0, 0};
  const auto r = image.channelIndex("R"), g = image.channelIndex("G"), b = image.channelIndex("B");
  if (!r || !g || !b) return std::nullopt;
  return std::array{*r, *g, *b};
}

/// Makes all values radiances, and says what was none.
void clean(FloatImage& image, std::vector<std::string>& warnings) {
  std::size_t none = 0, negative = 0, huge = 0;
  float brightest = 0.0f;
  for (const float value : image.values())
    if (value <= Environment::kBrightest) brightest = std::max(brightest, value);
  for (float& value : image.values()) {
    if (std::isnan(value)) {
      ++none;
      value = 0.0f;
    } else if (value < 0.0f) {
      ++negative;
      value = 0.0f;
    } else if (value > Environment::kBrightest) {
      ++huge;
      value = std::isinf(value) ? brightest : Environment::kBrightest;
    }
  }
  const auto warn = [&](std::size_t count, const char* what) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, what));
  };
  warn(none, "values are no numbers; they count as 0");
  warn(negative, "values are negative; they count as 0");
  warn(huge, "values are infinite or beyond all light; they count as the brightest of the others");
}

/// 1 inside of an interval of half-width `half` around 0, 0 outside, smooth over `edge`.
float softStep(float distance, float half, float edge) {
  const float t = std::clamp((half + 0.5f * edge - std::abs(distance)) / edge, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// A softbox: a rectangle of light around a direction, seen upright; sizes are tangents.
struct Softbox {
  glm::vec3 towards;
  glm::vec2 half;
  glm::vec3 radiance;

  glm::vec3 seen(glm::vec3 direction) const {
    const glm::vec3 z = glm::normalize(towards);
    const glm::vec3 x = glm::normalize(glm::cross(glm::vec3(0.01f, 1.0f, 0.0f), z));
    const glm::vec3 y = glm::cross(z, x);
    const float depth = glm::dot(direction, z);
    if (depth <= 0.0f) return glm::vec3(0.0f);
    const glm::vec2 place(glm::dot(direction, x) / depth, glm::dot(direction, y) / depth);
    return softStep(place.x, half.x, 0.06f) * softStep(place.y, half.y, 0.06f) * radiance;
  }
};

glm::vec3 studioRadiance(glm::vec3 direction) {
  // Key from the upper left in front, fill from the right, rim from behind; +Z is where the viewer
  // stands.
  static const std::array<Softbox, 3> boxes{{{{-0.9f, 0.9f, 0.9f}, {0.45f, 0.45f}, {5.4f, 5.16f, 4.8f}},
                                             {{1.0f, 0.35f, 0.8f}, {0.35f, 0.7f}, {0.96f, 1.08f, 1.26f}},
                                             {{0.5f, 0.8f, -1.0f}, {0.6f, 0.25f}, {3.6f, 3.72f, 3.96f}}}};
  const float up = direction.y;
  glm::vec3 sum =
      glm::mix(glm::vec3(0.06f, 0.057f, 0.054f), glm::vec3(0.132f, 0.138f, 0.15f), 0.5f + 0.5f * up);
  for (const Softbox& box : boxes) sum += box.seen(direction);
  return sum;
}

glm::vec3 skyRadiance(glm::vec3 direction) {
  const glm::vec3 sun = glm::normalize(glm::vec3(-0.75f, 0.55f, 0.6f));
  const float towardsSun = std::clamp(glm::dot(direction, sun), -1.0f, 1.0f);
  const float up = direction.y;
  const glm::vec3 haze(0.85f, 0.88f, 0.95f), zenith(0.16f, 0.32f, 0.75f), ground(0.14f, 0.12f, 0.10f);
  const float height = 1.0f - std::exp(-3.5f * std::max(up, 0.0f));
  glm::vec3 sky = glm::mix(haze, zenith, height);
  sky += 0.5f * glm::vec3(1.0f, 0.85f, 0.6f) * std::pow(std::max(towardsSun, 0.0f), 24.0f);
  glm::vec3 sum = glm::mix(ground, sky, softStep(1.0f - up, 1.0f, 0.02f));
  // Larger than the real one, so that a picture of 1024 columns holds it, and as bright as a hazy
  // noon.
  constexpr float kSunRadius = 0.02f;
  sum += softStep(std::acos(towardsSun), kSunRadius, 0.01f) * glm::vec3(1900.0f, 1700.0f, 1400.0f);
  return sum;
}

struct Builtin {
  const char* name;
  glm::vec3 (*radiance)(glm::vec3 direction);
};
constexpr std::array kBuiltins{Builtin{"studio", studioRadiance}, Builtin{"sky", skyRadiance}};

/// The share of row or column `from` (of `fromCount`) in each of `toCount` that it touches: where
/// it starts and ends in their units.
struct Overlap {
  int first;
  std::vector<double> shares;
};

Overlap overlapOf(int to, int toCount, int fromCount) {
  const double scale = static_cast<double>(fromCount) / toCount;
  const double begin = to * scale, end = (to + 1) * scale;
  Overlap overlap{static_cast<int>(begin), {}};
  for (int i = overlap.first; i < fromCount && i < end; ++i)
    overlap.shares.push_back(std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i)));
  return overlap;
}

}  // namespace

Result<Environment> Environment::create(const FloatImage& image, std::vector<std::string>& warnings) {
  const auto channels = colorChannels(image);
  if (image.empty() || !channels) return fail("an environment needs the channels R, G and B");
  FloatImage radiance = emptyImage(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c)
        radiance.at(x, y, static_cast<int>(c)) = image.at(x, y, (*channels)[c]);
  clean(radiance, warnings);
  if (image.width() != 2 * image.height() && !(image.width() == 1 && image.height() == 1))
    warnings.push_back(
        fmt::format("{} x {} pixels are not twice as wide as high; the picture is stretched around the whole "
                    "sphere",
                    image.width(), image.height()));
  return Environment(std::move(radiance));
}

Result<Environment> Environment::builtin(std::string_view name) {
  for (const Builtin& each : kBuiltins) {
    if (each.name != name) continue;
    constexpr int kWidth = 1024, kHeight = 512;
    FloatImage image = emptyImage(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::vec3 radiance = each.radiance(direction(
            glm::vec2((static_cast<float>(x) + 0.5f) / kWidth, (static_cast<float>(y) + 0.5f) / kHeight)));
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = radiance[c];
      }
    return Environment(std::move(image));
  }
  return fail(fmt::format("there is no built-in environment \"{}\"", name), {},
              fmt::format("there are {}", fmt::join(builtinNames(), ", ")));
}

std::vector<std::string> Environment::builtinNames() {
  std::vector<std::string> names;
  for (const Builtin& each : kBuiltins) names.emplace_back(each.name);
  return names;
}

Environment Environment::constant(glm::vec3 radiance) {
  FloatImage image = emptyImage(2, 1);
  for (int x = 0; x < 2; ++x)
    for (int c = 0; c < 3; ++c) image.at(x, 0, c) = radiance[c];
  return Environment(std::move(image));
}

glm::vec3 Environment::direction(glm::vec2 place) {
  const float theta = kPi * place.y, phi = 2.0f * kPi * (place.x - 0.5f);
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

glm::vec3 Environment::direction(int x, int y) const {
  return direction(glm::vec2((static_cast<float>(x) + 0.5f) / static_cast<float>(width()),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(height())));
}

glm::vec2 Environment::place(glm::vec3 direction) {
  return {0.5f + std::atan2(direction.x, -direction.z) / (2.0f * kPi),
          std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kPi};
}

double Environment::solidAngle(int y) const {
  const double step = std::numbers::pi / height();
  return 2.0 * std::numbers::pi / width() * (std::cos(step * y) - std::cos(step * (y + 1)));
}

Environment Environment::reduced(int newWidth, int newHeight) const {
  newWidth = std::min(newWidth, width());
  newHeight = std::min(newHeight, height());
  if (newWidth == width() && newHeight == height()) return *this;
  std::vector<Overlap> columns;
  for (int x = 0; x < newWidth; ++x) columns.push_back(overlapOf(x, newWidth, width()));
  FloatImage to = emptyImage(newWidth, newHeight);
  for (int y = 0; y < newHeight; ++y) {
    const Overlap rows = overlapOf(y, newHeight, height());
    for (int x = 0; x < newWidth; ++x) {
      const Overlap& across = columns[static_cast<std::size_t>(x)];
      glm::dvec3 sum(0.0);
      double weights = 0.0;
      for (std::size_t j = 0; j < rows.shares.size(); ++j)
        for (std::size_t i = 0; i < across.shares.size(); ++i) {
          const int row = rows.first + static_cast<int>(j);
          const double weight = rows.shares[j] * across.shares[i] * solidAngle(row);
          sum += weight * glm::dvec3(texel(across.first + static_cast<int>(i), row));
          weights += weight;
        }
      for (int c = 0; c < 3; ++c) to.at(x, y, c) = static_cast<float>(sum[c] / weights);
    }
  }
  return Environment(std::move(to));
}

glm::vec3 Environment::bilinear(glm::vec2 place) const {
  const glm::vec2 at = place * glm::vec2(width(), height()) - 0.5f;
  const glm::vec2 low = glm::floor(at), share = at - low;
  const int x0 = (static_cast<int>(low.x) + width()) % width(), x1 = (x0 + 1) % width();
  const int y0 = std::clamp(static_cast<int>(low.y), 0, height() - 1);
  const int y1 = std::clamp(static_cast<int>(low.y) + 1, 0, height() - 1);
  return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), share.x),
                  glm::mix(texel(x0, y1), texel(x1, y1), share.x), share.y);
}

Environment Environment::enlarged() const {
  constexpr int kFewest = 64, kWidth = 256, kHeight = 128;
  if (width() >= kFewest) return *this;
  FloatImage to = emptyImage(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const glm::vec3 radiance = bilinear((glm::vec2(x, y) + 0.5f) / glm::vec2(kWidth, kHeight));
      for (int c = 0; c < 3; ++c) to.at(x, y, c) = radiance[c];
    }
  return Environment(std::move(to));
}

}  // namespace weft
