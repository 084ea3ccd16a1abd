#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace weft {

constexpr int kMaximumLights = 256;
constexpr int kMaximumShadows = 8;  ///< lights that have a shadow map

// The std140 block `Frame` of shaders/lights.glsl.

struct LightBlock {
  glm::vec4 place{0.0f};      ///< position; or unit direction towards the light
  glm::vec4 intensity{0.0f};  ///< rgb; w: 1 / range^2
  /// the light grows with the square of dot(cone, (from the light, 1)), 0..1
  glm::vec4 cone{0.0f, 0.0f, 0.0f, 1.0f};
  /// x: layer of its shadow map, below 0 for none; y: size of a texel, at distance 1 from what has
  /// a place; zw: of a cube, depth = z - w / distance
  glm::vec4 shadow{-1.0f, 0.0f, 0.0f, 0.0f};
};

struct FrameBlock {
  glm::mat4 viewProjection{1.0f};
  /// relative to itself: (0, 0, 0, 1), or the direction of an orthographic view
  glm::vec4 eye{0.0f};
  glm::vec4 origin{0.0f};                           ///< the eye's place in the world
  std::array<LightBlock, kMaximumLights> lights{};  ///< the directional ones first
  std::array<glm::vec4, 3> environmentRows{};       ///< from world space to the environment
  glm::vec4 environmentIntensity{0.0f};             ///< rgb; w: EnvironmentLight::scale()
  /// by layer: from the world around the eye to the map, 0..1 in texture coordinates and depth
  std::array<glm::mat4, kMaximumShadows> shadowMatrices{};
};
static_assert(sizeof(FrameBlock) == 64 + 32 + kMaximumLights * 64 + 64 + kMaximumShadows * 64);

}  // namespace weft
