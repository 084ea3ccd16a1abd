#include "BoxTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "weft/scenegraph/Camera.h"

namespace weft {
namespace {

struct Box {
  glm::dvec3 center;
  glm::vec3 extent;
};

Frustum frustumOf(const Camera& camera, float aspect) {
  return {camera.position(), camera.projection(aspect) * glm::dmat4(glm::dmat3(camera.view))};
}

/// How far the innermost corner is inside of the plane that it is least inside of, by going over
/// all corners.
double inside(const Box& box, const Frustum& frustum) {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::vec4 plane : frustum.planes) {
    double innermost = -least;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const glm::dvec3 point = box.center + glm::dvec3(side) * glm::dvec3(box.extent) - frustum.eye;
      const double distance = glm::dot(glm::dvec3(plane), point) + double(plane.w);
      innermost = corner == 0 ? distance : std::max(innermost, distance);
    }
    least = std::min(least, innermost);
  }
  return least;
}

class BoxTableTest : public testing::Test {
 protected:
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); }
  glm::vec3 point(float size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

  /// Some of them clustered, so that whole blocks lie on one side.
  void fill(std::uint32_t count) {
    glm::vec3 cluster(0.0f);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i % 50 == 0) cluster = point(20.0f);
      boxes.push_back({cluster + point(2.0f), glm::abs(point(1.0f))});
      table.set(i, boxes.back().center, boxes.back().extent);
    }
    for (std::uint32_t i = 0; i < count; i += 7) table.clear(i);
    table.update();
  }
  static bool isGone(std::uint32_t number) { return number % 7 == 0; }

  std::mt19937 random{3};
  BoxTable table;
  std::vector<Box> boxes;
};

TEST_F(BoxTableTest, FindsEveryBoxThatIsNotOutside) {
  fill(1000);
  std::size_t foundInAll = 0;
  for (int i = 0; i < 50; ++i) {
    const Camera camera = Camera::lookAt(point(15.0f), point(5.0f));
    const Frustum frustum = frustumOf(camera, between(0.5f, 2.0f));
    std::vector<std::uint32_t> numbers;
    table.findInside(frustum, numbers);
    foundInAll += numbers.size();
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    std::vector<bool> found(boxes.size());
    for (const std::uint32_t number : numbers) found[number] = true;
    for (std::uint32_t number = 0; number < boxes.size(); ++number) {
      const double margin = inside(boxes[number], frustum);
      if (isGone(number) || margin < -1e-3 || margin >= 0.0) {
        EXPECT_EQ(found[number], !isGone(number) && margin >= 0.0) << number;
      }
    }
  }
  EXPECT_GT(foundInAll, 1000u);
}

TEST_F(BoxTableTest, FindsEveryBoxThatARayMeets) {
  fill(1000);
  for (int i = 0; i < 200; ++i) {
    const auto aim = static_cast<std::uint32_t>(random() % boxes.size());
    const Ray ray{point(20.0f)};
    const glm::dvec3 target = boxes[aim].center + glm::dvec3(boxes[aim].extent * point(1.0f));
    std::vector<std::uint32_t> numbers;
    table.findMet({ray.origin, target - ray.origin}, numbers);
    EXPECT_EQ(std::find(numbers.begin(), numbers.end(), aim) != numbers.end(), !isGone(aim));
    std::vector<std::uint32_t> behind;
    table.findMet({ray.origin, ray.origin - target}, behind);
    if (glm::distance(ray.origin, boxes[aim].center) > 2.0f) {
      EXPECT_EQ(std::find(behind.begin(), behind.end(), aim), behind.end());
    }
  }
}

TEST_F(BoxTableTest, FindsTheSameFarFromTheOrigin) {
  fill(1000);
  for (const double distance : {6.4e6, 1e9, 1e12}) {
    const glm::dvec3 origin = distance * glm::dvec3(1, -0.3, 1);
    BoxTable far;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      if (!isGone(i)) far.set(i, origin + boxes[i].center, boxes[i].extent);
    far.update();
    for (int round = 0; round < 20; ++round) {
      const glm::dvec3 eye = point(15.0f), target = point(5.0f);
      const Frustum frustum = frustumOf(Camera::lookAt(eye, target), 1.0f);
      std::vector<std::uint32_t> numbers, farNumbers;
      table.findInside(frustum, numbers);
      far.findInside(frustumOf(Camera::lookAt(origin + eye, origin + target), 1.0f), farNumbers);
      std::erase_if(numbers, [&](std::uint32_t i) { return std::abs(inside(boxes[i], frustum)) < 2e-2; });
      std::erase_if(farNumbers, [&](std::uint32_t i) { return std::abs(inside(boxes[i], frustum)) < 2e-2; });
      EXPECT_EQ(farNumbers, numbers);

      const auto aim = static_cast<std::uint32_t>(random() % boxes.size());
      std::vector<std::uint32_t> met;
      far.findMet({origin + eye, boxes[aim].center - eye}, met);
      EXPECT_EQ(std::find(met.begin(), met.end(), aim) != met.end(), !isGone(aim));
      EXPECT_LT(met.size(), boxes.size() / 5);
    }
  }
}

TEST_F(BoxTableTest, WhatIsNotANumberIsEverywhere) {
  fill(10);
  table.set(3, glm::vec3(std::numeric_limits<float>::quiet_NaN()), glm::vec3(1.0f));
  table.update();
  std::vector<std::uint32_t> numbers;
  const Camera camera = Camera::lookAt({500, 0, 0}, {600, 0, 0});
  table.findInside(frustumOf(camera, 1.0f), numbers);
  EXPECT_NE(std::find(numbers.begin(), numbers.end(), 3u), numbers.end());
}

}  // namespace
}  // namespace weft
