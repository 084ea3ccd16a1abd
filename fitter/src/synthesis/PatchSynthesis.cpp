#include "PatchSynthesis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "PatchCut.h"
#include "SeamPolish.h"

namespace weft {
namespace {

constexpr std::size_t kCandidates = 1024, kRefined = 4, kCut = 12;
constexpr int kPolishRounds = 3;
/// How many random places are looked at for candidates.
constexpr int kTries = 16384;
/// How far the phase of a patch may be off, in periods.
constexpr double kPhaseTolerance = 0.09;
/// How much a source that was used as often as all on average costs more than an unused one.
constexpr double kUsageCost = 0.15;
constexpr int kUsageCells = 8;

struct Candidate {
  glm::ivec2 place;
  float cost = 0.0f;
};

bool isBetter(const Candidate& a, const Candidate& b) {
  if (a.cost != b.cost) return a.cost < b.cost;
  return a.place.y != b.place.y ? a.place.y < b.place.y : a.place.x < b.place.x;
}

/// A patch that is to be placed.
struct Cell {
  glm::ivec2 first;  ///< its top left texel; may lie before the torus' first
  glm::ivec2 size;
  Overlap overlap;
};

class PatchCover {
 public:
  PatchCover(const PatchSource& source, const PatchSize& patches, int width, int height, std::uint64_t seed)
      : source_(source),
        size_(width, height),
        overlap_(patches.overlap),
        columns_(std::max(width / patches.step, 2)),
        rows_(std::max(height / patches.step, 2)),
        waves_(fitted(source.lattice(), width, height)),
        random_(seed),
        texels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        usage_(kUsageCells * kUsageCells) {}

  std::vector<glm::ivec2> run(const Progress& progress) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) place(cellAt(column, row));
      if (progress) progress(static_cast<double>(row + 1) / rows_);
    }
    polishSeams(source_, size_, texels_, kPolishRounds);
    for (glm::ivec2& texel : texels_) texel = source_.sampleTexel(texel);
    return std::move(texels_);
  }

 private:
  glm::ivec2& at(glm::ivec2 texel) {
    const int x = (texel.x + size_.x) % size_.x, y = (texel.y + size_.y) % size_.y;
    return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) +
                   static_cast<std::size_t>(x)];
  }

  Cell cellAt(int column, int row) const {
    const auto border = [](int i, int count, int size) {
      return static_cast<int>(std::int64_t{size} * i / count);
    };
    const glm::ivec2 from(border(column, columns_, size_.x), border(row, rows_, size_.y));
    const glm::ivec2 to(border(column + 1, columns_, size_.x), border(row + 1, rows_, size_.y));
    return {from - overlap_ / 2,
            to - from + overlap_,
            {column > 0, row > 0, column == columns_ - 1, row == rows_ - 1, overlap_}};
  }

  void place(const Cell& cell) {
    std::vector<Candidate> candidates = candidatesFor(cell);
    rank(cell, candidates);
    glm::ivec2 best = candidates.front().place;
    PatchCut bestCut;
    double lowest = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates) {
      PatchCut cut = cutPatch(cell.size, cell.overlap, [&](int x, int y) {
        return source_.difference(at(cell.first + glm::ivec2(x, y)), candidate.place + glm::ivec2(x, y));
      });
      const double cost = (cut.cost + 1e-9) * (1.0 + kUsageCost * usageOf(candidate.place, cell.size));
      if (cost < lowest) lowest = cost, best = candidate.place, bestCut = std::move(cut);
    }
    for (int y = 0; y < cell.size.y; ++y)
      for (int x = 0; x < cell.size.x; ++x)
        if (bestCut.taken[static_cast<std::size_t>(y * cell.size.x + x)])
          at(cell.first + glm::ivec2(x, y)) = best + glm::ivec2(x, y);
    use(best, cell.size);
    offsets_.push_back(source_.sampleTexel(best - cell.first + 64 * size_));
  }

  // --- Candidates ---

  double phaseAt(std::size_t wave, const Lattice& lattice, glm::ivec2 place) const {
    return lattice.waves[wave].x * place.x + lattice.waves[wave].y * place.y;
  }

  bool showsPhase(const Cell& cell, glm::ivec2 place, double tolerance) const {
    for (std::size_t i = 0; i < waves_.waves.size(); ++i) {
      const double off = phaseAt(i, source_.lattice(), place) - phaseAt(i, waves_, cell.first);
      if (std::abs(off - std::round(off)) > tolerance) return false;
    }
    return true;
  }

  std::vector<Candidate> candidatesFor(const Cell& cell) {
    const SourceRegion places = source_.placesOf(cell.size);
    std::vector<Candidate> candidates;
    for (double tolerance = kPhaseTolerance; candidates.empty(); tolerance *= 1.5) {
      const int count = places.width * places.height;
      const bool tryAll = count <= kTries;
      for (int i = 0; tryAll ? i < count : i < kTries && candidates.size() < kCandidates; ++i) {
        const int n = tryAll ? i : static_cast<int>(random_() % static_cast<std::uint64_t>(count));
        const glm::ivec2 place(places.x + n % places.width, places.y + n / places.width);
        // At last a place that goes on is better than none: a small sample has few offsets.
        if (showsPhase(cell, place, tolerance) && (tolerance > 1.0 || !continues(cell, place)))
          candidates.push_back({place});
      }
    }
    // Of more than are compared, some that lie evenly.
    if (const std::size_t found = candidates.size(); found > kCandidates) {
      for (std::size_t i = 0; i < kCandidates; ++i) candidates[i] = candidates[i * found / kCandidates];
      candidates.resize(kCandidates);
    }
    return candidates;
  }

  /// Whether a patch there goes on with the sample as one of the last row's length does, those
  /// beside it among them.
  bool continues(const Cell& cell, glm::ivec2 place) const {
    const glm::ivec2 offset = source_.sampleTexel(place - cell.first + 64 * size_);
    return std::find(offsets_.end() - std::min<std::ptrdiff_t>(columns_ + 1, std::ssize(offsets_)),
                     offsets_.end(), offset) != offsets_.end();
  }

  /// Keeps the candidates that continue what is there best, and others beside them.
  void rank(const Cell& cell, std::vector<Candidate>& candidates) {
    const std::vector<glm::ivec2> compared = comparedTexels(cell);
    if (compared.empty()) {
      candidates = {candidates[random_() % candidates.size()]};
      return;
    }
    const SourceRegion places = source_.placesOf(cell.size);
    compare(cell, compared, candidates);
    keepBest(candidates, kRefined);
    const std::vector<Candidate> best = candidates;
    for (const Candidate& candidate : best)
      for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
          const glm::ivec2 place = candidate.place + glm::ivec2(x, y);
          if (!continues(cell, place) && place.x >= places.x && place.y >= places.y &&
              place.x < places.x + places.width && place.y < places.y + places.height)
            candidates.push_back({place});
        }
    compare(cell, compared, candidates);
    keepBest(candidates, kCut);
  }

  static void keepBest(std::vector<Candidate>& candidates, std::size_t count) {
    std::sort(candidates.begin(), candidates.end(), isBetter);
    const auto same = [](const Candidate& a, const Candidate& b) { return a.place == b.place; };
    candidates.erase(std::unique(candidates.begin(), candidates.end(), same), candidates.end());
    candidates.resize(std::min(candidates.size(), count));
  }

  /// Every second texel of the strips.
  std::vector<glm::ivec2> comparedTexels(const Cell& cell) {
    std::vector<glm::ivec2> texels;
    const Overlap& o = cell.overlap;
    for (int y = 0; y < cell.size.y; y += 2)
      for (int x = y / 2 % 2; x < cell.size.x; x += 2)
        if ((o.left && x < o.width) || (o.top && y < o.width) || (o.right && x >= cell.size.x - o.width) ||
            (o.bottom && y >= cell.size.y - o.width))
          texels.emplace_back(x, y);
    for (std::size_t i = texels.size(); i > 1; --i) std::swap(texels[i - 1], texels[random_() % i]);
    return texels;
  }

  void compare(const Cell& cell, const std::vector<glm::ivec2>& compared,
               std::vector<Candidate>& candidates) {
    constexpr int kQuick = PatchSource::kQuick;
    std::vector<float> there;
    for (const glm::ivec2 texel : compared) {
      const float* vector = source_.quick(at(cell.first + texel));
      there.insert(there.end(), vector, vector + kQuick);
    }
    for (Candidate& candidate : candidates) {
      float sum = 0.0f;
      for (std::size_t i = 0; i < compared.size(); ++i) {
        const float *a = there.data() + i * kQuick, *b = source_.quick(candidate.place + compared[i]);
        for (int d = 0; d < kQuick; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
      }
      candidate.cost = sum;
    }
  }

  // --- How often sources were used ---

  double& usageAt(glm::ivec2 place, glm::ivec2 size) {
    const SourceRegion places = source_.placesOf(size);
    const int x = (place.x - places.x) * kUsageCells / places.width,
              y = (place.y - places.y) * kUsageCells / places.height;
    return usage_[static_cast<std::size_t>(y * kUsageCells + x)];
  }
  /// 1 on average.
  double usageOf(glm::ivec2 place, glm::ivec2 size) {
    return uses_ > 0.0 ? usageAt(place, size) * static_cast<double>(usage_.size()) / uses_ : 0.0;
  }
  void use(glm::ivec2 place, glm::ivec2 size) {
    usageAt(place, size) += 1.0;
    uses_ += 1.0;
  }

  const PatchSource& source_;
  glm::ivec2 size_;
  int overlap_;
  int columns_, rows_;
  Lattice waves_;
  std::mt19937_64 random_;
  std::vector<glm::ivec2> texels_;
  std::vector<double> usage_;
  double uses_ = 0.0;
  std::vector<glm::ivec2> offsets_;
};

}  // namespace

PatchSize patchSizeFor(const SourceRegion& sources, int width, int height) {
  const int side = std::clamp(std::min(sources.width, sources.height) * 2 / 5, 6, 96);
  const int step = std::clamp(side * 3 / 5, 2, std::min(width, height) / 2);
  return {step, std::clamp((side - step) / 2 * 2, 2, step / 2 * 2)};
}

std::vector<glm::ivec2> synthesizePatches(const PatchSource& source, const PatchSize& patches, int width,
                                          int height, std::uint64_t seed, const Progress& progress) {
  return PatchCover(source, patches, width, height, seed).run(progress);
}

}  // namespace weft
