#include "solvers/PhongMeanFit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "MemoryBtf.h"

namespace weft {
namespace {

PhongMean fitOf(const PhongMean& truth, std::span<const glm::vec3> views, std::span<const glm::vec3> lights) {
  std::vector<double> values, cosines;
  for (const glm::vec3 view : views)
    for (const glm::vec3 light : lights) {
      cosines.push_back(double{light.z});
      values.push_back(cosines.back() * double{truth.value(light, view)});
    }
  const std::vector<double> weights(values.size(), 1.0);
  return fitPhongMean(views, lights, values, weights, cosines, 80.0f);
}

TEST(PhongMeanFit, IsRecovered) {
  const std::vector<glm::vec3> directions = test::ubo2003Sampling();
  const PhongMean truth{0.1f, 0.4f, 0.3f, std::exp(std::log(80.0f) * 20 / 40)};
  const PhongMean found = fitOf(truth, directions, directions);
  EXPECT_NEAR(found.ambient, truth.ambient, 1e-3f);
  EXPECT_NEAR(found.diffuse, truth.diffuse, 1e-3f);
  EXPECT_NEAR(found.specular, truth.specular, 1e-3f);
  EXPECT_NEAR(found.exponent, truth.exponent, 1e-2f);
}

TEST(PhongMeanFit, OfOnePairIsFiniteAndGivesItsValue) {
  const std::vector<glm::vec3> pole{{0, 0, 1}};
  const PhongMean found = fitOf({0.2f, 0.3f, 0.1f, 5.0f}, pole, pole);
  EXPECT_NEAR(found.value(pole[0], pole[0]), 0.6f, 1e-5f);
  EXPECT_EQ(found.exponent, 1.0f);
}

}  // namespace
}  // namespace weft
