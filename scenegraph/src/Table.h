#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace weft {

/// Things by number; numbers that became free are given again, so that those in use stay close
/// together.
template <class T>
class Table {
 public:
  std::uint32_t add(T thing) {
    if (free_.empty()) {
      things_.push_back(std::move(thing));
      return static_cast<std::uint32_t>(things_.size() - 1);
    }
    const std::uint32_t number = free_.back();
    free_.pop_back();
    things_[number] = std::move(thing);
    return number;
  }
  /// Leaves a default-constructed thing there.
  void remove(std::uint32_t number) {
    things_[number] = T();
    free_.push_back(number);
  }

  T& operator[](std::uint32_t number) { return things_[number]; }
  const T& operator[](std::uint32_t number) const { return things_[number]; }
  /// All numbers ever given.
  const std::vector<T>& all() const { return things_; }
  std::vector<T>& all() { return things_; }
  std::size_t used() const { return things_.size() - free_.size(); }

 private:
  std::vector<T> things_;
  std::vector<std::uint32_t> free_;
};

}  // namespace weft
