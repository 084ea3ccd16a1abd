#include "weft/baking/Pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "Constants.h"
#include "weft/core/Contract.h"

namespace weft {

namespace {

// --- Noise that repeats with the unit square ---

float hashed(int column, int row, int seed) {
  std::uint32_t h = static_cast<std::uint32_t>(column) * 0x8da6b343u ^
                    static_cast<std::uint32_t>(row) * 0xd8163841u ^
                    static_cast<std::uint32_t>(seed) * 0xcb1ab31fu;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return static_cast<float>((h ^ (h >> 16)) >> 8) * 0x1p-24f;
}

/// Smooth values of -1..1 on a lattice of `cells` that wraps around.
float noise(glm::vec2 p, glm::ivec2 cells, int seed) {
  const glm::vec2 scaled = p * glm::vec2(cells);
  const glm::vec2 corner = glm::floor(scaled);
  const glm::vec2 t = glm::smoothstep(glm::vec2(0.0f), glm::vec2(1.0f), scaled - corner);
  const auto lattice = [&](int dx, int dy) {
    const int column = ((static_cast<int>(corner.x) + dx) % cells.x + cells.x) % cells.x;
    const int row = ((static_cast<int>(corner.y) + dy) % cells.y + cells.y) % cells.y;
    return 2.0f * hashed(column, row, seed) - 1.0f;
  };
  return glm::mix(glm::mix(lattice(0, 0), lattice(1, 0), t.x), glm::mix(lattice(0, 1), lattice(1, 1), t.x),
                  t.y);
}

float fractalNoise(glm::vec2 p, glm::ivec2 cells, int octaves, int seed) {
  float sum = 0.0f;
  float amplitude = 0.5f;
  for (int octave = 0; octave < octaves; ++octave, amplitude *= 0.5f, cells *= 2)
    sum += amplitude * noise(p, cells, seed + octave);
  return sum;
}

/// The height of a circular arch of half width 1 at `x`.
float arch(float x) {
  return std::sqrt(std::max(0.0f, 1.0f - x * x));
}

// --- Patterns: samples of the unit square, x to the right, y up ---

/// Three ribs along y with a pile of tufts.
HeightField::Sample corduroy(glm::vec2 p) {
  const float wobble = 0.010f * noise(p, {6, 7}, 1) + 0.006f * noise(p, {12, 20}, 2);
  const float across = 3.0f * (p.x + wobble);
  const float fromMiddle = std::abs(2.0f * (across - std::floor(across)) - 1.0f);
  const float rib = std::sqrt(std::max(0.0f, 1.0f - std::pow(fromMiddle, 2.5f)));
  const float tufts = fractalNoise(p, {18, 26}, 2, 3);
  const float fibres = fractalNoise(p, {72, 72}, 3, 5);

  HeightField::Sample sample;
  sample.height = 0.088f * rib + glm::mix(0.3f, 1.0f, rib) * (0.015f * tufts + 0.003f * fibres);
  const float shade = 1.0f + 0.45f * tufts + 0.6f * fibres + 0.15f * noise(p, {5, 7}, 9);
  sample.albedo = shade * glm::mix(glm::vec3(0.10f, 0.045f, 0.016f), glm::vec3(0.36f, 0.175f, 0.05f), rib);
  sample.specular = 0.02f;
  return sample;
}

/// The highest of the yarns that cross at a place: plain weave of four by four, warp light, weft
/// blue.
HeightField::Sample weave(glm::vec2 p) {
  constexpr float kYarns = 4.0f;
  constexpr float kHalfWidth = 0.44f;
  constexpr float kThickness = 0.050f;
  HeightField::Sample sample;
  sample.height = -0.06f;
  sample.albedo = glm::vec3(0.05f);
  for (const bool isWarp : {true, false}) {
    const float across = kYarns * (isWarp ? p.x : p.y);
    const float along = kYarns * (isWarp ? p.y : p.x);
    const int seed = isWarp ? 20 : 40;
    const auto yarn = static_cast<int>(std::floor(across));
    const float wander = 0.05f * noise(p, {4, 4}, seed);
    const float offset = (across - std::floor(across) - 0.5f + wander) / kHalfWidth;
    if (std::abs(offset) >= 1.0f) continue;
    // Warp and weft cross in the middle of a cell, one of them at its highest and the other at its
    // lowest.
    const float parity = ((yarn % 2 == 0) == isWarp) ? 1.0f : -1.0f;
    const float centre = parity * std::cos(kPi * (along - 0.5f));
    const float twist = std::cos(2.0f * kPi * (3.0f * along + 1.1f * offset));
    const float fibre = fractalNoise(p, isWarp ? glm::ivec2(64, 32) : glm::ivec2(32, 64), 2, seed + 1);
    const float height =
        0.030f * centre + kThickness * arch(offset) + 0.0035f * twist * arch(offset) + 0.005f * fibre;
    if (height <= sample.height) continue;
    sample.height = height;
    const glm::vec3 colour = isWarp ? glm::vec3(0.66f, 0.59f, 0.46f) : glm::vec3(0.07f, 0.15f, 0.36f);
    const float tint = 1.0f + 0.12f * (2.0f * hashed(yarn, 0, seed + 3) - 1.0f);
    sample.albedo = colour * tint * (1.0f + 0.10f * twist + 0.25f * fibre);
  }
  sample.specular = 0.06f;
  return sample;
}

/// Four by four glazed tiles with rounded edges in rough grout.
HeightField::Sample tiles(glm::vec2 p) {
  constexpr float kTiles = 4.0f;
  const glm::vec2 scaled = kTiles * p;
  const glm::vec2 cell = glm::floor(scaled);
  const glm::vec2 within = scaled - cell - 0.5f;
  const auto random = [&](int seed) {
    return hashed(static_cast<int>(cell.x), static_cast<int>(cell.y), seed);
  };
  // Distance to the edge of a square with rounded corners, in tile widths; positive inside.
  const glm::vec2 corner = glm::max(glm::abs(within) - 0.36f, 0.0f);
  const float edge =
      0.09f - std::sqrt(corner.x * corner.x + corner.y * corner.y) + 0.006f * noise(p, {32, 32}, 60);

  HeightField::Sample sample;
  if (edge <= 0.0f) {
    const float grain = fractalNoise(p, {64, 64}, 2, 61);
    sample.height = 0.004f * grain;
    sample.albedo = glm::vec3(0.36f, 0.34f, 0.31f) * (1.0f + 0.35f * grain);
    return sample;
  }
  const float bevel = std::min(edge / 0.09f, 1.0f);
  const glm::vec2 tilt = 0.012f * glm::vec2(2.0f * random(62) - 1.0f, 2.0f * random(63) - 1.0f);
  sample.height = 0.020f + 0.022f * arch(1.0f - bevel) + 0.006f * random(64) -
                  0.030f * glm::dot(within, within) + within.x * tilt.x + within.y * tilt.y +
                  0.0012f * noise(p, {16, 16}, 65);
  const std::array<glm::vec3, 4> glazes{glm::vec3(0.05f, 0.27f, 0.30f), glm::vec3(0.10f, 0.36f, 0.37f),
                                        glm::vec3(0.03f, 0.17f, 0.26f), glm::vec3(0.52f, 0.50f, 0.42f)};
  const glm::vec3 glaze = glazes[std::min(static_cast<std::size_t>(4.0f * random(66)), std::size_t{3})];
  sample.albedo = glaze * (0.85f + 0.15f * bevel + 0.12f * fractalNoise(p, {20, 20}, 3, 67));
  sample.specular = 0.05f;
  return sample;
}

/// Staggered hemispheres on a plane.
HeightField::Sample bumps(glm::vec2 p) {
  constexpr float kRows = 4.0f;
  constexpr float kRadius = 0.4f;  // of a row
  const float row = std::floor(kRows * p.y);
  const float shift = static_cast<int>(row) % 2 == 0 ? 0.0f : 0.5f;
  const float across = kRows * p.x + shift;
  const glm::vec2 within{across - std::floor(across) - 0.5f, kRows * p.y - row - 0.5f};
  const float distance = std::sqrt(within.x * within.x + within.y * within.y) / kRadius;

  HeightField::Sample sample;
  const float grain = fractalNoise(p, {40, 40}, 2, 80);
  if (distance < 1.0f) {
    sample.height = kRadius / kRows * arch(distance);
    sample.albedo = glm::vec3(0.62f, 0.16f, 0.07f) * (1.0f + 0.15f * grain);
    sample.specular = 0.10f;
  } else {
    sample.height = 0.003f * grain;
    sample.albedo = glm::vec3(0.42f, 0.40f, 0.36f) * (1.0f + 0.25f * grain);
    sample.specular = 0.03f;
  }
  return sample;
}

struct Pattern {
  std::string_view name;
  HeightField::Sample (*sampleAt)(glm::vec2 p);
  float roughness;
};

constexpr std::array<Pattern, 4> kPatterns{
    {{"corduroy", corduroy, 0.5f}, {"weave", weave, 0.45f}, {"tiles", tiles, 0.22f}, {"bumps", bumps, 0.3f}}};

}  // namespace

const std::vector<std::string_view>& patternNames() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names;
    for (const Pattern& pattern : kPatterns) names.push_back(pattern.name);
    return names;
  }();
  return kNames;
}

Result<HeightField> makePattern(std::string_view name, int resolution) {
  WEFT_EXPECT(resolution > 0, "a pattern needs at least one sample");
  const auto pattern =
      std::find_if(kPatterns.begin(), kPatterns.end(), [&](const Pattern& p) { return p.name == name; });
  if (pattern == kPatterns.end()) {
    std::string known;
    for (const Pattern& p : kPatterns) known += (known.empty() ? "" : ", ") + std::string(p.name);
    return fail("there is no pattern '" + std::string(name) + "'", {}, "one of " + known);
  }
  const float spacing = 1.0f / static_cast<float>(resolution);
  HeightField field(resolution, resolution, spacing);
  for (int row = 0; row < resolution; ++row)
    for (int column = 0; column < resolution; ++column) {
      const glm::vec2 p{(static_cast<float>(column) + 0.5f) * spacing,
                        1.0f - (static_cast<float>(row) + 0.5f) * spacing};
      field.at(column, row) = pattern->sampleAt(p);
      field.at(column, row).roughness = pattern->roughness;
    }
  field.centre();
  return field;
}

}  // namespace weft
