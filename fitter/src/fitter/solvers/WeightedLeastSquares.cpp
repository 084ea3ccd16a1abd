// Highway compiles this file once for every instruction set: AVX-512, AVX2 and what every processor
// has.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solvers/WeightedLeastSquares.cpp"
#include <hwy/foreach_target.h>
// Highway's header must come after that.
#include <hwy/highway.h>

#include <algorithm>

#include "solvers/WeightedLeastSquares.h"
#include "weft/core/Contract.h"

HWY_BEFORE_NAMESPACE();
namespace weft {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Vector = hn::Vec<Tag>;

// Samples whose sums stay in registers: their terms and sets stay in the nearest caches, and
// sums of few floats, added up, lose less than one of all.
constexpr std::size_t kChunk = SharedTerms::kSamplesAtOnce;
constexpr std::size_t kSets = WeightedLeastSquares::kSetsAtOnce;
// Rows of sums at once: as many as there are registers for, with two vectors of sets.
constexpr std::size_t kRows = HWY_TARGET <= HWY_AVX3 ? 12 : 6;

// The samples of kSets sets side by side, in blocks of two vectors: [block][sample][set].
struct SetBlock {
  HWY_ALIGN float values[kSets * kChunk];
  HWY_ALIGN float squares[kSets * kChunk];

  static HWY_INLINE std::size_t indexOf(std::size_t set, std::size_t sample) {
    const std::size_t width = 2 * hn::Lanes(Tag());
    return (set / width * kChunk + sample) * width + set % width;
  }
};

// Adds the products of kRows rows of terms with one or two vectors of sets.
template <std::size_t kVectors>
HWY_INLINE void addTile(const float* rows, const float* sets, float* sums) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  Vector tile[kRows][kVectors];
  for (auto& row : tile)
    for (Vector& sum : row) sum = hn::Zero(d);
  for (std::size_t i = 0; i < kChunk; ++i) {
    Vector columns[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) columns[v] = hn::Load(d, sets + (2 * i + v) * lanes);
    for (std::size_t r = 0; r < kRows; ++r) {
      const Vector term = hn::Set(d, rows[r * kChunk + i]);
      for (std::size_t v = 0; v < kVectors; ++v) tile[r][v] = hn::MulAdd(term, columns[v], tile[r][v]);
    }
  }
  for (std::size_t r = 0; r < kRows; ++r)
    for (std::size_t v = 0; v < kVectors; ++v) {
      float* sum = sums + r * kSets + v * lanes;
      hn::Store(hn::Add(hn::Load(d, sum), tile[r][v]), d, sum);
    }
}

HWY_INLINE void addTiles(const float* rows, const float* block, std::size_t sets, float* sums) {
  const std::size_t lanes = hn::Lanes(Tag());
  for (std::size_t set = 0; set < sets; set += 2 * lanes)
    if (sets - set > lanes)
      addTile<2>(rows, block + set * kChunk, sums + set);
    else
      addTile<1>(rows, block + set * kChunk, sums + set);
}

// The sums of one group of at most kSets sets: entries of the lower triangle by rows, padded to
// whole tiles, and right sides, likewise; a number a set each.
struct Sums {
  std::size_t unknowns;
  AlignedFloats normals;
  AlignedFloats rights;
  HWY_ALIGN float meanSquares[kSets];

  static std::size_t wholeTiles(std::size_t rows) { return (rows + kRows - 1) / kRows * kRows; }
  explicit Sums(std::size_t count)
      : unknowns(count),
        normals(wholeTiles(count * (count + 1) / 2) * kSets),
        rights(wholeTiles(count) * kSets) {}
};

void addNormals(const SharedTerms& terms, std::size_t first, const SetBlock& block, std::size_t sets,
                Sums& sums) {
  const Tag d;
  HWY_ALIGN float rows[kRows * kChunk];
  const std::size_t entries = terms.unknowns * (terms.unknowns + 1) / 2;
  std::size_t i = 0;
  std::size_t j = 0;
  for (std::size_t entry = 0; entry < entries; entry += kRows) {
    for (std::size_t r = 0; r < kRows; ++r) {
      const float* left = terms.of(i) + first;
      const float* right = terms.of(j) + first;
      for (std::size_t s = 0; s < kChunk; s += hn::Lanes(d))
        hn::Store(hn::Mul(hn::Load(d, left + s), hn::Load(d, right + s)), d, rows + r * kChunk + s);
      if (++j > i) j = 0, i = i + 1 < terms.unknowns ? i + 1 : 0;
    }
    addTiles(rows, block.squares, sets, sums.normals.data() + entry * kSets);
  }
}

void addRights(const SharedTerms& terms, std::size_t first, const SetBlock& block, std::size_t sets,
               Sums& sums) {
  HWY_ALIGN float rows[kRows * kChunk];
  for (std::size_t k = 0; k < terms.unknowns; k += kRows) {
    for (std::size_t r = 0; r < kRows; ++r)
      std::copy_n(terms.of(std::min(k + r, terms.unknowns - 1)) + first, kChunk, rows + r * kChunk);
    addTiles(rows, block.values, sets, sums.rights.data() + k * kSets);
  }
}

// Cholesky's decomposition in place, a set a lane, with reciprocals on the diagonal. A pivot that
// vanished leaves its unknown at 0.
void decompose(std::size_t unknowns, float* normals) {
  const Tag d;
  for (std::size_t i = 0; i < unknowns; ++i) {
    float* row = normals + i * (i + 1) / 2 * kSets;
    for (std::size_t j = 0; j <= i; ++j) {
      const float* other = normals + j * (j + 1) / 2 * kSets;
      const Vector whole = hn::Load(d, row + j * kSets);
      Vector rest = whole;
      for (std::size_t k = 0; k < j; ++k)
        rest = hn::NegMulAdd(hn::Load(d, row + k * kSets), hn::Load(d, other + k * kSets), rest);
      if (j < i) {
        hn::Store(hn::Mul(rest, hn::Load(d, other + j * kSets)), d, row + j * kSets);
      } else {
        const auto usable =
            hn::And(hn::Gt(rest, hn::Mul(whole, hn::Set(d, 1e-6f))), hn::Gt(rest, hn::Set(d, 1e-30f)));
        const Vector root = hn::Sqrt(hn::IfThenElse(usable, rest, hn::Set(d, 1.0f)));
        hn::Store(hn::IfThenElseZero(usable, hn::Div(hn::Set(d, 1.0f), root)), d, row + j * kSets);
      }
    }
  }
}

// Turns right sides into solutions.
void substitute(std::size_t unknowns, const float* factor, float* rights) {
  const Tag d;
  const auto at = [&](std::size_t i, std::size_t j) {
    return hn::Load(d, factor + (i * (i + 1) / 2 + j) * kSets);
  };
  for (std::size_t i = 0; i < unknowns; ++i) {
    Vector rest = hn::Load(d, rights + i * kSets);
    for (std::size_t k = 0; k < i; ++k) rest = hn::NegMulAdd(at(i, k), hn::Load(d, rights + k * kSets), rest);
    hn::Store(hn::Mul(rest, at(i, i)), d, rights + i * kSets);
  }
  for (std::size_t i = unknowns; i-- > 0;) {
    Vector rest = hn::Load(d, rights + i * kSets);
    for (std::size_t k = i + 1; k < unknowns; ++k)
      rest = hn::NegMulAdd(at(k, i), hn::Load(d, rights + k * kSets), rest);
    hn::Store(hn::Mul(rest, at(i, i)), d, rights + i * kSets);
  }
}

void addRidge(const AlignedFloats& ridge, Sums& sums) {
  for (std::size_t k = 0; k < sums.unknowns; ++k)
    for (std::size_t set = 0; set < kSets; ++set)
      sums.normals[(k * (k + 3) / 2) * kSets + set] += ridge[k] * sums.meanSquares[set];
}

// Squared weights and weighted values of a chunk of samples; of missing ones, zeros.
void gatherWeighted(const float* values, const float* squares, std::size_t sets, std::size_t samples,
                    std::size_t first, SetBlock& block, Sums& sums) {
  const std::size_t count = std::min(kChunk, samples - first);
  for (std::size_t set = 0; set < sets; ++set) {
    const float* value = values + set * samples + first;
    const float* square = squares + set * samples + first;
    float sum = 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = SetBlock::indexOf(set, i);
      block.squares[at] = square[i];
      block.values[at] = square[i] * value[i];
      sum += square[i];
    }
    for (std::size_t i = count; i < kChunk; ++i)
      block.squares[SetBlock::indexOf(set, i)] = block.values[SetBlock::indexOf(set, i)] = 0.0f;
    sums.meanSquares[set] += sum / static_cast<float>(samples);
  }
}

void gatherValues(const float* values, std::size_t sets, std::size_t samples, std::size_t first,
                  SetBlock& block) {
  const std::size_t count = std::min(kChunk, samples - first);
  for (std::size_t set = 0; set < sets; ++set)
    for (std::size_t i = 0; i < kChunk; ++i)
      block.values[SetBlock::indexOf(set, i)] = i < count ? values[set * samples + first + i] : 0.0f;
}

void clear(SetBlock& block, Sums& sums) {
  std::fill_n(block.values, kSets * kChunk, 0.0f);
  std::fill_n(block.squares, kSets * kChunk, 0.0f);
  std::fill_n(sums.normals.data(), sums.normals.size(), 0.0f);
  std::fill_n(sums.rights.data(), sums.rights.size(), 0.0f);
  std::fill_n(sums.meanSquares, kSets, 0.0f);
}

void write(const Sums& sums, std::size_t sets, float* out) {
  for (std::size_t set = 0; set < sets; ++set)
    for (std::size_t k = 0; k < sums.unknowns; ++k)
      out[set * sums.unknowns + k] = sums.rights[k * kSets + set];
}

void solveHere(const SharedTerms& terms, const float* values, const float* squares, std::size_t setCount,
               float* solutions) {
  SetBlock block;
  Sums sums(terms.unknowns);
  for (std::size_t set = 0; set < setCount; set += kSets) {
    const std::size_t sets = std::min(kSets, setCount - set);
    clear(block, sums);
    for (std::size_t first = 0; first < terms.samples; first += kChunk) {
      gatherWeighted(values + set * terms.samples, squares + set * terms.samples, sets, terms.samples, first,
                     block, sums);
      addNormals(terms, first, block, sets, sums);
      addRights(terms, first, block, sets, sums);
    }
    addRidge(terms.ridge, sums);
    for (std::size_t lane = 0; lane < sets; lane += hn::Lanes(Tag())) {
      decompose(terms.unknowns, sums.normals.data() + lane);
      substitute(terms.unknowns, sums.normals.data() + lane, sums.rights.data() + lane);
    }
    write(sums, sets, solutions + set * terms.unknowns);
  }
}

void projectHere(const SharedTerms& terms, const float* values, std::size_t setCount, float* products) {
  SetBlock block;
  Sums sums(terms.unknowns);
  for (std::size_t set = 0; set < setCount; set += kSets) {
    const std::size_t sets = std::min(kSets, setCount - set);
    clear(block, sums);
    for (std::size_t first = 0; first < terms.samples; first += kChunk) {
      gatherValues(values + set * terms.samples, sets, terms.samples, first, block);
      addRights(terms, first, block, sets, sums);
    }
    write(sums, sets, products + set * terms.unknowns);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace weft
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace weft {

HWY_EXPORT(solveHere);
HWY_EXPORT(projectHere);

SharedTerms::SharedTerms(std::span<const float> values, std::size_t count)
    : samples(values.size() / count),
      unknowns(count),
      stride((samples + kSamplesAtOnce - 1) / kSamplesAtOnce * kSamplesAtOnce),
      terms(unknowns * stride),
      ridge(unknowns) {
  WEFT_EXPECT(values.size() == samples * unknowns, "every sample has all terms");
  for (std::size_t i = 0; i < samples; ++i)
    for (std::size_t k = 0; k < unknowns; ++k) {
      const float term = values[i * unknowns + k];
      terms[k * stride + i] = term;
      ridge[k] += WeightedLeastSquares::kRidge * term * term;
    }
}

void WeightedLeastSquares::solve(std::span<const float> values, std::span<const float> squaredWeights,
                                 std::span<float> solutions) const {
  const std::size_t sets = solutions.size() / unknowns();
  WEFT_EXPECT(values.size() == sets * samples() && squaredWeights.size() == values.size(),
              "every set has all samples and weights");
  HWY_DYNAMIC_DISPATCH(solveHere)
  (terms_, values.data(), squaredWeights.data(), sets, solutions.data());
}

void WeightedLeastSquares::project(std::span<const float> values, std::span<float> products) const {
  const std::size_t sets = products.size() / unknowns();
  WEFT_EXPECT(values.size() == sets * samples(), "every set has all samples");
  HWY_DYNAMIC_DISPATCH(projectHere)(terms_, values.data(), sets, products.data());
}

}  // namespace weft
#endif
