#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace weft {

constexpr int kMaximumLights = 16;

// The std140 blocks of shaders/lights.glsl (Frame) and shaders/mesh.vert (Object).

struct LightBlock {
  glm::vec4 place{0.0f};      ///< position, w = 1; or unit direction towards the light, w = 0
  glm::vec4 intensity{0.0f};  ///< rgb
};

struct FrameBlock {
  glm::mat4 viewProjection{1.0f};
  glm::vec4 eye{0.0f};
  glm::ivec4 lightCount{0};  ///< x
  std::array<LightBlock, kMaximumLights> lights{};
};
static_assert(sizeof(FrameBlock) == 64 + 16 + 16 + kMaximumLights * 32);

struct ObjectBlock {
  glm::mat4 model{1.0f};
  glm::mat4 normalMatrix{1.0f};
};
static_assert(sizeof(ObjectBlock) == 128);

constexpr unsigned kFrameBinding = 0;
constexpr unsigned kObjectBinding = 1;

}  // namespace weft
