#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// One object to draw.
struct DrawItem {
  std::uint64_t key = 0;
  std::uint32_t object = 0;  ///< number in FlatScene::objects()
};

/// What decides when an object is drawn. Numbers larger than their bits only cost changes of state.
struct DrawOrder {
  bool blended = false;
  std::uint32_t program = 0;   ///< 8 bits
  std::uint32_t material = 0;  ///< 14 bits
  std::uint32_t kind = 0;      ///< 3 bits: what else cannot be in one draw call
  std::uint32_t page = 0;      ///< 5 bits: of the mesh pool
  std::uint32_t mesh = 0;      ///< 14 bits: the same for objects to be drawn as instances
  float depth = 0.0f;          ///< in front of the camera; behind it counts as 0

  std::uint64_t key() const;
};

/// What a frame draws, in the order that changes the least state: opaque things by program,
/// material, mesh, then from front to back; then the blended ones from back to front.
class DrawList {
 public:
  void clear() { items_.clear(); }
  void add(const DrawOrder& order, std::uint32_t object) { items_.push_back({order.key(), object}); }
  /// Items with equal keys keep the order in which they were added.
  void sort();

  std::span<const DrawItem> items() const { return items_; }

 private:
  std::vector<DrawItem> items_;
  std::vector<DrawItem> spare_;
};

}  // namespace weft
