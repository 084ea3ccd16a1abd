#include "solvers/TrainingTexels.h"

#include <algorithm>

namespace weft {
namespace {

constexpr std::size_t kSamples = 40'000'000;
constexpr std::size_t kTexels = 6000;

}  // namespace

TrainingTexels::TrainingTexels(int width, int height, std::size_t pairs) : width_(width) {
  std::vector<std::uint64_t> ranks;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ranks.push_back(rankOf(x, y));
  if (ranks.empty()) return;
  count_ =
      std::clamp(kSamples / std::max<std::size_t>(pairs, 1), std::size_t{1}, std::min(kTexels, ranks.size()));
  const auto last = ranks.begin() + static_cast<std::ptrdiff_t>(count_ - 1);
  std::nth_element(ranks.begin(), last, ranks.end());
  lastRank_ = *last;
}

bool TrainingTexels::contains(int x, int y) const {
  return count_ > 0 && rankOf(x, y) <= lastRank_;
}

// The finaliser of SplitMix64: it maps no two numbers to one.
std::uint64_t TrainingTexels::rankOf(int x, int y) const {
  std::uint64_t rank = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width_) +
                       static_cast<std::uint64_t>(x) + 0x9e3779b97f4a7c15;
  rank = (rank ^ (rank >> 30)) * 0xbf58476d1ce4e5b9;
  rank = (rank ^ (rank >> 27)) * 0x94d049bb133111eb;
  return rank ^ (rank >> 31);
}

std::vector<std::size_t> spreadLights(std::size_t lights, std::size_t wanted) {
  const std::size_t count = std::min(lights, wanted);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back((2 * i + 1) * lights / (2 * count));
  return chosen;
}

}  // namespace weft
