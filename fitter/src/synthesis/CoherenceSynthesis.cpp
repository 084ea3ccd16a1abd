#include "CoherenceSynthesis.h"

#include <algorithm>
#include <limits>
#include <random>

namespace weft {
namespace {

/// One layer of the surface.
class CoherentLayer {
 public:
  CoherentLayer(const AnalysedLayer& sample, int width, int height, int k, std::mt19937_64& random)
      : sample_(sample),
        width_(width),
        height_(height),
        k_(k),
        random_(random),
        texels_(static_cast<std::size_t>(width * height), kNone),
        seen_(sample.textons.ofTexel.size()) {}

  void fillAtRandom() {
    for (std::int32_t& texel : texels_) texel = randomTexel();
  }

  /// The texel (x, y) of the coarser layer is (2 x, 2 y) here.
  void preset(const CoherentLayer& coarser) {
    const int s = sample_.neighborhood;
    for (int y = 0; y < height_; y += 2)
      for (int x = 0; x < width_; x += 2) {
        const std::int32_t from =
            coarser.texel(std::min(x / 2, coarser.width_ - 1), std::min(y / 2, coarser.height_ - 1));
        const int column = std::clamp(2 * (from % coarser.sample_.width), s, sample_.width - 1 - s);
        const int row = std::clamp(2 * (from / coarser.sample_.width), s, sample_.height - 1 - s);
        texel(x, y) = row * sample_.width + column;
      }
  }

  /// The texels whose columns and rows are both even, the others, or all.
  enum class Which { Preset, Others, All };

  void synthesize(Which which) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const bool isPreset = x % 2 == 0 && y % 2 == 0;
        if (which == Which::All || isPreset == (which == Which::Preset)) texel(x, y) = bestAt(x, y, which);
      }
  }

  glm::ivec2 sourceAt(int x, int y) const {
    return {texel(x, y) % sample_.width, texel(x, y) / sample_.width};
  }

 private:
  static constexpr std::int32_t kNone = -1;

  /// A texel beside the one that is looked for: how far it is from each texton, and where the
  /// sample has it beside a candidate.
  struct Neighbour {
    const float* distances;
    std::int32_t offset;
    std::int32_t source;
  };

  std::int32_t& texel(int x, int y) { return texels_[static_cast<std::size_t>(y * width_ + x)]; }
  std::int32_t texel(int x, int y) const { return texels_[static_cast<std::size_t>(y * width_ + x)]; }

  std::int32_t randomTexel() {
    const int s = sample_.neighborhood;
    const auto below = [&](int count) {
      return static_cast<int>(random_() % static_cast<std::uint64_t>(count));
    };
    const int row = s + below(sample_.height - 2 * s);
    return row * sample_.width + s + below(sample_.width - 2 * s);
  }

  static int wrapped(int i, int size) {
    while (i < 0) i += size;
    while (i >= size) i -= size;
    return i;
  }

  /// Those before in scan line order, and what else there is in finer layers.
  void collectNeighbours(int x, int y, Which which) {
    const int s = sample_.neighborhood;
    neighbours_.clear();
    for (int dy = -s; dy <= (which == Which::All ? 0 : s); ++dy) {
      const int row = wrapped(y + dy, height_);
      for (int dx = -s; dx <= s; ++dx) {
        const bool isBefore = dy < 0 || (dy == 0 && dx < 0);
        const int column = wrapped(x + dx, width_);
        const bool isPreset = column % 2 == 0 && row % 2 == 0;
        if ((dx == 0 && dy == 0) ||
            !(isBefore || which == Which::Preset || (which == Which::Others && isPreset)))
          continue;
        if (const std::int32_t source = texel(column, row); source != kNone)
          neighbours_.push_back({sample_.textons.distancesFrom(static_cast<std::size_t>(source)),
                                 dy * sample_.width + dx, source});
      }
    }
  }

  void consider(std::int32_t candidate, float& least, std::int32_t& best) {
    if (seen_[static_cast<std::size_t>(candidate)] == stamp_) return;
    seen_[static_cast<std::size_t>(candidate)] = stamp_;
    const std::uint16_t* textons = sample_.textons.ofTexel.data() + candidate;
    float sum = 0.0f;
    for (const Neighbour& n : neighbours_) {
      sum += n.distances[textons[n.offset]];
      if (sum >= least) return;
    }
    least = sum;
    best = candidate;
  }

  std::int32_t bestAt(int x, int y, Which which) {
    collectNeighbours(x, y, which);
    ++stamp_;
    std::int32_t best = kNone;
    float least = std::numeric_limits<float>::max();
    for (const Neighbour& n : neighbours_) {
      // A source keeps clear of the border by as much as an offset reaches, so that no row is left.
      const std::int32_t candidate = n.source - n.offset;
      if (!sample_.hasNeighborhood(candidate % sample_.width, candidate / sample_.width)) continue;
      consider(candidate, least, best);
      for (int i = 0; i + 1 < k_; ++i)
        consider(
            sample_
                .similar[static_cast<std::size_t>(candidate) * kSimilarTexels + static_cast<std::size_t>(i)],
            least, best);
    }
    return best == kNone ? randomTexel() : best;
  }

  const AnalysedLayer& sample_;
  int width_, height_, k_;
  std::mt19937_64& random_;
  std::vector<std::int32_t> texels_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t stamp_ = 0;
  std::vector<Neighbour> neighbours_;
};

std::vector<glm::ivec2> sourcesIn(const CoherentLayer& layer, int width, int height) {
  std::vector<glm::ivec2> sources;
  sources.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) sources.push_back(layer.sourceAt(x, y));
  return sources;
}

}  // namespace

std::vector<glm::ivec2> synthesizeCoherently(const std::vector<AnalysedLayer>& layers, int width, int height,
                                             int k, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<CoherentLayer> surface;
  for (std::size_t i = 0; i < layers.size(); ++i)
    surface.emplace_back(layers[i], std::max(width >> i, 1), std::max(height >> i, 1), k, random);
  surface.back().fillAtRandom();
  surface.back().synthesize(CoherentLayer::Which::All);
  surface.back().synthesize(CoherentLayer::Which::All);
  for (std::size_t i = layers.size() - 1; i-- > 0;) {
    surface[i].preset(surface[i + 1]);
    surface[i].synthesize(CoherentLayer::Which::Others);
    surface[i].synthesize(CoherentLayer::Which::Preset);
  }
  return sourcesIn(surface.front(), width, height);
}

std::vector<glm::ivec2> synthesizeByJumps(const AnalysedLayer& layer, int width, int height,
                                          std::uint64_t seed) {
  constexpr std::uint64_t kJumpOneIn = 8;
  std::mt19937_64 random(seed);
  const int s = layer.neighborhood;
  const auto below = [&](int count) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(count));
  };
  const auto jumped = [&](std::int32_t texel) {
    const float* probability = layer.probability.data() + texel * kSimilarTexels;
    const float drawn = static_cast<float>(random() >> 40) * 0x1p-24f;
    const auto i = std::upper_bound(probability, probability + kSimilarTexels - 1, drawn) - probability;
    return layer.similar[static_cast<std::size_t>(texel * kSimilarTexels + i)];
  };
  std::vector<glm::ivec2> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto at = [&](int x, int y) -> glm::ivec2& {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool fromAbove = y > 0 && (x == 0 || random() % 2 == 0);
      glm::ivec2 source(s + below(layer.width - 2 * s), s + below(layer.height - 2 * s));
      if (fromAbove)
        source = at(x, y - 1) + glm::ivec2(0, 1);
      else if (x > 0)
        source = at(x - 1, y) + glm::ivec2(1, 0);
      const glm::ivec2 before = fromAbove ? at(x, y - 1) : x > 0 ? at(x - 1, y) : source;
      if (!layer.hasNeighborhood(source.x, source.y) || random() % kJumpOneIn == 0) {
        const std::int32_t to = jumped(before.y * layer.width + before.x);
        source = {to % layer.width, to / layer.width};
      }
      at(x, y) = source;
    }
  return texels;
}

}  // namespace weft
