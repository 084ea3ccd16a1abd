#include "SimilarNeighborhoods.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace weft {
namespace {

constexpr int kStripRows = 16;

/// The best few of the texels that one is compared with.
class BestTexels {
 public:
  void consider(float distance, std::int32_t texel) {
    if (distance >= worst_) return;
    int i = kSimilarTexels - 1;
    for (; i > 0 && best_[i - 1].first > distance; --i) best_[i] = best_[i - 1];
    best_[i] = {distance, texel};
    worst_ = best_[kSimilarTexels - 1].first;
  }
  const std::pair<float, std::int32_t>& operator[](int i) const { return best_[i]; }

  BestTexels() { std::fill(std::begin(best_), std::end(best_), std::pair(worst_, -1)); }

 private:
  float worst_ = std::numeric_limits<float>::max();
  std::pair<float, std::int32_t> best_[kSimilarTexels];
};

/// Compares the neighbourhoods of the rows first .. last - 1 with those at one shift. Distances of
/// texels are computed once a shift, and summed along rows.
class StripSearch {
 public:
  StripSearch(const AnalysedLayer& layer, int first, int last)
      : layer_(layer),
        s_(layer.neighborhood),
        first_(first),
        last_(last),
        best_(static_cast<std::size_t>(layer.width * (last - first))),
        single_(rowsSize()),
        summed_(rowsSize()) {}

  void compare(int dx, int dy) {
    const int s = s_, from = std::max(0, -dx), to = std::min(layer_.width, layer_.width - dx);
    if (to - from <= 2 * s) return;
    const int top = std::max({first_, s, s - dy}),
              bottom = std::min({last_, layer_.height - s, layer_.height - s - dy});
    if (top >= bottom) return;
    for (int y = top - s; y < bottom; ++y) compareRow(y, dx, dy, from, to);
    for (int y = top; y < bottom; ++y) {
      const float* own = row(single_, y);
      for (int x = from + s; x < to - s; ++x) {
        float sum = 0.0f;
        for (int i = 1; i <= s; ++i) sum += own[x - i] + row(summed_, y - i)[x];
        best_[static_cast<std::size_t>((y - first_) * layer_.width + x)].consider(
            sum, (y + dy) * layer_.width + x + dx);
      }
    }
  }

  const BestTexels& best(int x, int y) const {
    return best_[static_cast<std::size_t>((y - first_) * layer_.width + x)];
  }

 private:
  std::size_t rowsSize() const { return static_cast<std::size_t>(layer_.width * (last_ - first_ + s_)); }
  float* row(std::vector<float>& rows, int y) { return rows.data() + (y - first_ + s_) * layer_.width; }

  void compareRow(int y, int dx, int dy, int from, int to) {
    const std::uint16_t* there = layer_.textons.ofTexel.data() + (y + dy) * layer_.width + dx;
    float *single = row(single_, y), *summed = row(summed_, y);
    for (int x = from; x < to; ++x)
      single[x] = layer_.textons.distancesFrom(static_cast<std::size_t>(y * layer_.width + x))[there[x]];
    for (int x = from + s_; x < to - s_; ++x) {
      float sum = 0.0f;
      for (int i = -s_; i <= s_; ++i) sum += single[x + i];
      summed[x] = sum;
    }
  }

  const AnalysedLayer& layer_;
  int s_, first_, last_;
  std::vector<BestTexels> best_;
  std::vector<float> single_, summed_;
};

void keepBestOf(const BestTexels& best, std::size_t texel, AnalysedLayer& layer) {
  const std::size_t first = texel * kSimilarTexels;
  // Half as likely where it is as far again as the best one.
  const float unit = best[0].second >= 0 ? best[0].first + 1e-6f : 1.0f;
  float sum = 0.0f;
  for (int i = 0; i < kSimilarTexels; ++i) {
    const bool isThere = best[i].second >= 0;
    layer.similar[first + static_cast<std::size_t>(i)] =
        isThere ? best[i].second : static_cast<std::int32_t>(texel);
    sum += isThere || i == 0 ? unit / (unit + best[i].first) : 0.0f;
    layer.probability[first + static_cast<std::size_t>(i)] = sum;
  }
  for (std::size_t i = 0; i < kSimilarTexels; ++i)
    layer.probability[first + i] = sum > 0.0f ? layer.probability[first + i] / sum : 1.0f;
}

void analyseStrip(AnalysedLayer& layer, int first, int last) {
  StripSearch search(layer, first, last);
  for (int dy = -layer.height + 1; dy < layer.height; ++dy)
    for (int dx = -layer.width + 1; dx < layer.width; ++dx)
      if (dx != 0 || dy != 0) search.compare(dx, dy);
  for (int y = first; y < last; ++y)
    for (int x = 0; x < layer.width; ++x)
      keepBestOf(search.best(x, y), static_cast<std::size_t>(y * layer.width + x), layer);
}

}  // namespace

AnalysedLayer analyseLayer(const AppearanceVectors& vectors, int neighborhood, int textons) {
  AnalysedLayer layer{vectors.width, vectors.height, neighborhood, findTextons(vectors, textons), {}, {}};
  const std::size_t texels = layer.textons.ofTexel.size();
  layer.similar.resize(texels * kSimilarTexels);
  layer.probability.resize(texels * kSimilarTexels);
  tbb::parallel_for(0, (layer.height + kStripRows - 1) / kStripRows, [&](int strip) {
    analyseStrip(layer, strip * kStripRows, std::min(layer.height, (strip + 1) * kStripRows));
  });
  return layer;
}

}  // namespace weft
