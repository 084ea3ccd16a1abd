#include "weft/reflectance/StochasticTiling.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_uint2.hpp>
#include <glm/geometric.hpp>

namespace weft {
namespace {

// The numbers of shaders/where_stochastic.glsl.
constexpr float kEdge = 0.25f;  // of a triangle, in samples
const float kRootOf3 = std::sqrt(3.0f);

struct Triangle {
  std::array<glm::ivec2, 3> vertices;
  glm::vec3 weights;
};

Triangle triangleAround(glm::vec2 skewed) {
  const glm::ivec2 base = glm::floor(skewed);
  const glm::vec2 upper = skewed - glm::vec2(base);
  const float last = 1.0f - upper.x - upper.y;
  const bool isFar = last < 0.0f;
  return {{base + (isFar ? 1 : 0), base + glm::ivec2(1, 0), base + glm::ivec2(0, 1)},
          isFar ? glm::vec3(-last, 1.0f - upper.y, 1.0f - upper.x) : glm::vec3(last, upper.x, upper.y)};
}

glm::vec2 randomOf(glm::ivec2 vertex) {
  glm::uvec2 v = glm::uvec2(vertex) * 1664525u + 1013904223u;
  for (int round = 0; round < 2; ++round) {
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
  }
  return glm::vec2(v) * 0x1p-32f;
}

glm::vec2 placeOf(glm::ivec2 vertex) {
  const glm::vec2 skewed(vertex);
  return kEdge * glm::vec2(skewed.x + 0.5f * skewed.y, 0.5f * kRootOf3 * skewed.y);
}

}  // namespace

StochasticPlace stochasticPlace(glm::vec2 texcoord) {
  const glm::vec2 scaled = texcoord / kEdge;
  const Triangle triangle = triangleAround({scaled.x - scaled.y / kRootOf3, 2.0f / kRootOf3 * scaled.y});
  const glm::vec3 shares = triangle.weights / glm::length(triangle.weights);
  StochasticPlace place{{}, 1.0f - shares.x - shares.y - shares.z};
  for (int i = 0; i < 3; ++i) {
    const glm::ivec2 vertex = triangle.vertices[static_cast<std::size_t>(i)];
    place.taps[static_cast<std::size_t>(i)] = {randomOf(vertex) + texcoord - placeOf(vertex), shares[i]};
  }
  return place;
}

}  // namespace weft
