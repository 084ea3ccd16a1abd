#include "weft/reflectance/LayerLookup.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "MemoryBtf.h"
#include "TestSupport.h"

namespace weft {
namespace {

// Directions evenly spread over the hemisphere, with some below the horizon.
std::vector<glm::vec3> randomDirections(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1.0f, 1.0f);
  std::vector<glm::vec3> directions;
  while (static_cast<int>(directions.size()) < count) {
    const glm::vec3 d(number(random), number(random), 0.55f * number(random) + 0.45f);
    if (glm::length(d) > 0.1f && glm::length(d) < 1.0f) directions.push_back(glm::normalize(d));
  }
  return directions;
}

TEST(LayerLookup, EqualsTheTriangulationButForCubeTexelsAcrossAnEdge) {
  const std::vector<glm::vec3> views = test::ubo2003Sampling();
  const auto triangulation = test::valueOf(HemisphereTriangulation::create(views));
  const LayerLookup lookup = LayerLookup::create(triangulation);

  int across = 0;
  const std::vector<glm::vec3> directions = randomDirections(20000);
  for (const glm::vec3 direction : directions) {
    const DirectionWeights exact = triangulation.locate(direction);
    const DirectionWeights found = lookup.locate(triangulation, direction);
    std::vector<float> difference(views.size(), 0.0f);
    for (int k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(k);
      difference[static_cast<std::size_t>(exact.index[corner])] += exact.weight[k];
      difference[static_cast<std::size_t>(found.index[corner])] -= found.weight[k];
    }
    float worst = 0.0f;
    for (float value : difference) worst = std::max(worst, std::abs(value));
    if (worst > 1e-4f) ++across;
    // A cube texel is at most 1/64 wide, a triangle at least 0.13 high: that much may be given to
    // the wrong corner.
    EXPECT_LT(worst, 0.15f) << direction.x << " " << direction.y << " " << direction.z;
  }
  EXPECT_LT(across, static_cast<int>(directions.size()) / 10);
}

TEST(LayerLookup, FindsEveryMeasuredView) {
  const std::vector<glm::vec3> views = test::ubo2003Sampling();
  const auto triangulation = test::valueOf(HemisphereTriangulation::create(views));
  const LayerLookup lookup = LayerLookup::create(triangulation);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const DirectionWeights found = lookup.locate(triangulation, views[i]);
    EXPECT_EQ(found.nearest(), static_cast<int>(i));
    EXPECT_GT(std::max({found.weight.x, found.weight.y, found.weight.z}), 0.999f);
  }
}

}  // namespace
}  // namespace weft
