#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace weft {

/// Where in a square map of the hemisphere a direction lies: Lambert's equal-area disc, whose edge
/// touches the centres of the outermost texels. In texels from the centre of the first; columns
/// follow x, rows y.
glm::vec2 lightMapPlace(glm::vec3 light, int size);

/// The four texels around a place in a light map, as indices row * size + column, and their
/// weights.
struct LightMapTexels {
  int index[4];
  float weight[4];
};
LightMapTexels lightMapTexels(glm::vec3 light, int size);

}  // namespace weft
