#include "BoxTable.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace weft {

namespace {

constexpr float kInfiniteFloat = std::numeric_limits<float>::infinity();

/// How far outside a box may seem to be although it touches the plane: rounding of sums of this
/// size.
float rounding(glm::vec4 plane, glm::vec3 center, glm::vec3 extent) {
  const float size = glm::dot(glm::abs(glm::vec3(plane)), glm::abs(center) + extent) + std::abs(plane.w);
  return 8.0f * std::numeric_limits<float>::epsilon() * size;
}

/// Whether the half-line meets the box; slabs that it is parallel to and in give NaN, which lets it
/// pass.
bool meets(const Ray& ray, const glm::dvec3& center, glm::vec3 extent) {
  // Of the rounding of extents, of places, and of the quotients.
  constexpr double ofExtent = 4.0 * std::numeric_limits<float>::epsilon();
  constexpr double ofPlace = 8.0 * std::numeric_limits<double>::epsilon();
  double enter = 0.0, leave = kInfiniteFloat;
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = center[axis] - ray.origin[axis];
    const double reach = double{extent[axis]} * (1.0 + ofExtent) +
                         ofPlace * (std::abs(center[axis]) + std::abs(ray.origin[axis]));
    if (ray.direction[axis] == 0.0) {
      if (std::abs(offset) > reach) return false;
      continue;
    }
    const double a = (offset - reach) / ray.direction[axis], b = (offset + reach) / ray.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return !(enter > leave * (1.0 + ofPlace));
}

/// Appends first + i for every bit i of the mask.
void append(std::uint64_t mask, std::size_t block, std::vector<std::uint32_t>& numbers) {
  const auto first = static_cast<std::uint32_t>(block * BoxTable::kBlock);
  for (; mask != 0; mask &= mask - 1)
    numbers.push_back(first + static_cast<std::uint32_t>(std::countr_zero(mask)));
}

}  // namespace

void BoxTable::set(std::uint32_t number, const glm::dvec3& center, glm::vec3 extent) {
  if (number / kBlock >= blocks_.size()) blocks_.resize(number / kBlock + 1);
  Block& block = blocks_[number / kBlock];
  for (int axis = 0; axis < 3; ++axis) {
    block.center[static_cast<std::size_t>(axis)][number % kBlock] = center[axis];
    block.extent[static_cast<std::size_t>(axis)][number % kBlock] = extent[axis];
  }
  block.occupied |= std::uint64_t{1} << number % kBlock;
  if (!std::exchange(block.changed, true)) changed_.push_back(number / kBlock);
}

void BoxTable::clear(std::uint32_t number) {
  Block& block = blocks_[number / kBlock];
  block.occupied &= ~(std::uint64_t{1} << number % kBlock);
  if (!std::exchange(block.changed, true)) changed_.push_back(number / kBlock);
}

void BoxTable::update() {
  for (const std::uint32_t block : changed_) mend(blocks_[block]);
  changed_.clear();
}

void BoxTable::mend(Block& block) {
  block.changed = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = kInfiniteFloat, high = -kInfiniteFloat;
    for (std::uint64_t mask = block.occupied; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(mask));
      const double center = block.center[axis][i], extent = double{block.extent[axis][i]};
      low = std::min(low, center - extent);
      high = std::max(high, center + extent);
      // What is not a number lies everywhere.
      if (std::isnan(center + extent)) low = -kInfiniteFloat, high = kInfiniteFloat;
    }
    block.blockCenter[static_cast<int>(axis)] = 0.5 * (low + high);
    block.blockExtent[static_cast<int>(axis)] = static_cast<float>(0.5 * (high - low));
  }
}

std::array<BoxTable::Lane, 3> BoxTable::centersFrom(const glm::dvec3& eye, const Block& block) {
  std::array<Lane, 3> centers;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < kBlock; ++i)
      centers[axis][i] = static_cast<float>(block.center[axis][i] - eye[static_cast<int>(axis)]);
  return centers;
}

std::uint64_t BoxTable::insideMask(const Block& block, const Frustum& frustum) {
  const glm::vec3 blockCenter(block.blockCenter - frustum.eye);
  bool allInside = true;
  for (const glm::vec4 plane : frustum.planes) {
    const glm::vec3 normal(plane);
    const float distance = glm::dot(normal, blockCenter) + plane.w;
    const float reach = glm::dot(glm::abs(normal), block.blockExtent);
    const float slack = rounding(plane, blockCenter, block.blockExtent);
    if (distance + reach < -slack) return 0;
    allInside = allInside && distance - reach >= slack;
  }
  if (allInside) return block.occupied;

  // How far the innermost corner of each box is inside the plane that it is least inside of.
  const std::array<Lane, 3> centers = centersFrom(frustum.eye, block);
  Lane inside;
  inside.fill(kInfiniteFloat);
  for (const glm::vec4 plane : frustum.planes) {
    const glm::vec3 reach = glm::abs(glm::vec3(plane));
    const float offset = plane.w + rounding(plane, blockCenter, block.blockExtent);
    const float* cx = centers[0].data();
    const float* cy = centers[1].data();
    const float* cz = centers[2].data();
    const float* ex = block.extent[0].data();
    const float* ey = block.extent[1].data();
    const float* ez = block.extent[2].data();
    for (std::size_t i = 0; i < kBlock; ++i) {
      const float distance = offset + plane.x * cx[i] + plane.y * cy[i] + plane.z * cz[i] + reach.x * ex[i] +
                             reach.y * ey[i] + reach.z * ez[i];
      inside[i] = distance < inside[i] ? distance : inside[i];  // not for NaN
    }
  }
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < kBlock; ++i) mask |= std::uint64_t{inside[i] >= 0.0f} << i;
  return mask & block.occupied;
}

void BoxTable::findInside(const Frustum& frustum, std::vector<std::uint32_t>& numbers) const {
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    if (blocks_[i].occupied != 0) append(insideMask(blocks_[i], frustum), i, numbers);
}

template <class Visitor>
void BoxTable::forEach(const Visitor& visit) const {
  for (const Block& block : blocks_)
    for (std::uint64_t mask = block.occupied; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(mask));
      visit(glm::dvec3(block.center[0][i], block.center[1][i], block.center[2][i]),
            glm::dvec3(block.extent[0][i], block.extent[1][i], block.extent[2][i]));
    }
}

BoxTable::Extent BoxTable::along(const glm::dvec3& axis) const {
  Extent extent{kInfiniteFloat, -kInfiniteFloat};
  forEach([&](const glm::dvec3& center, const glm::dvec3& half) {
    const double middle = glm::dot(axis, center), reach = glm::dot(glm::abs(axis), half);
    if (!std::isfinite(middle + reach)) return;
    extent = {std::min(extent.low, middle - reach), std::max(extent.high, middle + reach)};
  });
  return extent;
}

double BoxTable::reachFrom(const glm::dvec3& place) const {
  double reach = 0.0;
  forEach([&](const glm::dvec3& center, const glm::dvec3& half) {
    const double farthest = glm::length(glm::abs(center - place) + half);
    if (std::isfinite(farthest)) reach = std::max(reach, farthest);
  });
  return reach;
}

void BoxTable::findMet(const Ray& ray, std::vector<std::uint32_t>& numbers) const {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Block& block = blocks_[i];
    if (block.occupied == 0 || !meets(ray, block.blockCenter, block.blockExtent)) continue;
    std::uint64_t met = 0;
    for (std::uint64_t mask = block.occupied; mask != 0; mask &= mask - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(mask));
      const glm::dvec3 center(block.center[0][k], block.center[1][k], block.center[2][k]);
      const glm::vec3 extent(block.extent[0][k], block.extent[1][k], block.extent[2][k]);
      if (meets(ray, center, extent)) met |= std::uint64_t{1} << k;
    }
    append(met, i, numbers);
  }
}

}  // namespace weft
