#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "Frustum.h"
#include "weft/scenegraph/Ray.h"

namespace weft {

/// World-space boxes by number, in blocks of 64 neighbours that have a box around them: what is
/// outside is mostly found out block by block, and within one by loops that the compiler makes SIMD
/// of. Places are doubles, and floats once they are relative to an eye.
///
/// Neighbours in number are neighbours in the tree, and mostly in space.
class BoxTable {
 public:
  static constexpr std::uint32_t kBlock = 64;

  void set(std::uint32_t number, const glm::dvec3& center, glm::vec3 extent);
  void clear(std::uint32_t number);
  /// Mends the blocks around what set() and clear() changed; to be called before the questions
  /// below.
  void update();

  glm::dvec3 center(std::uint32_t number) const {
    const auto& center = blocks_[number / kBlock].center;
    return {center[0][number % kBlock], center[1][number % kBlock], center[2][number % kBlock]};
  }
  struct Extent {
    double low, high;
  };
  /// What all boxes take of an axis, unit; low > high where there are none. Boxes with NaN are left
  /// out.
  Extent along(const glm::dvec3& axis) const;
  /// The distance within which all boxes lie; 0 where there are none.
  double reachFrom(const glm::dvec3& place) const;
  /// Appends the numbers, rising, of the boxes that are not wholly outside one of the planes. Boxes
  /// with NaN count as inside.
  void findInside(const Frustum& frustum, std::vector<std::uint32_t>& numbers) const;
  /// The same of the boxes that the ray meets.
  void findMet(const Ray& ray, std::vector<std::uint32_t>& numbers) const;

 private:
  using Lane = std::array<float, kBlock>;
  using PlaceLane = std::array<double, kBlock>;
  /// Center and half of the size, by axis.
  struct Block {
    std::array<PlaceLane, 3> center{};
    std::array<Lane, 3> extent{};
    glm::dvec3 blockCenter{};
    glm::vec3 blockExtent{};
    std::uint64_t occupied = 0;
    bool changed = false;
  };

  /// Calls a function with centre and extent of every box.
  template <class Visitor>
  void forEach(const Visitor& visit) const;
  static void mend(Block& block);
  static std::array<Lane, 3> centersFrom(const glm::dvec3& eye, const Block& block);
  static std::uint64_t insideMask(const Block& block, const Frustum& frustum);

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> changed_;  ///< blocks to mend
};

}  // namespace weft
