// Highway compiles this file once for every instruction set: AVX-512, AVX2 and what every processor
// has.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solvers/LobeSolver.cpp"
#include <hwy/foreach_target.h>
// Highway's header must come after that.
#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "weft/core/SimdMath-inl.h"
#include "weft/fitter/LobeSolver.h"

HWY_BEFORE_NAMESPACE();
namespace weft {
namespace HWY_NAMESPACE {

// The normal equations of N unknowns: the lower triangle of J^T J, row by row, J^T r and r^T r; and
// the residuals' product with what the diffuse albedo is multiplied by.
template <int N>
struct NormalEquations {
  static constexpr int kTriangle = N * (N + 1) / 2;
  std::array<Vector, kTriangle> matrix;
  std::array<Vector, N> gradient;
  Vector cost;
  Vector diffuseSlope;

  void takeFrom(const NormalEquations& other, Mask where) {
    for (int i = 0; i < kTriangle; ++i) matrix[i] = hn::IfThenElse(where, other.matrix[i], matrix[i]);
    for (int i = 0; i < N; ++i) gradient[i] = hn::IfThenElse(where, other.gradient[i], gradient[i]);
    cost = hn::IfThenElse(where, other.cost, cost);
    diffuseSlope = hn::IfThenElse(where, other.diffuseSlope, diffuseSlope);
  }
};

// What a lobe's value and derivatives need that is the same for all lights.
struct LobeTerms {
  Vector m[3], byX[3], byY[3];  // the direction and its derivatives
  Vector amplitude, twiceRoot;
  Vector exponentLessOne, amplitudeTimesExponent;
  Vector exponentByBend;  // times ln 2, for log2
};

HWY_INLINE LobeTerms termsOf(const Vector* p, float largestExponent) {
  LobeTerms terms;
  const Vector one = constant(1.0f);
  const Vector squared = hn::MulAdd(p[1], p[1], hn::Mul(p[2], p[2]));
  const Vector inverse = hn::Div(one, hn::Add(one, squared));
  const Vector twice = hn::Add(inverse, inverse);
  terms.m[0] = hn::Mul(p[1], twice);
  terms.m[1] = hn::Mul(p[2], twice);
  terms.m[2] = hn::Mul(hn::Sub(one, squared), inverse);
  for (int axis = 0; axis < 3; ++axis) {
    terms.byX[axis] = hn::Neg(hn::Mul(hn::Mul(p[1], twice), terms.m[axis]));
    terms.byY[axis] = hn::Neg(hn::Mul(hn::Mul(p[2], twice), terms.m[axis]));
  }
  terms.byX[0] = hn::Add(terms.byX[0], twice);
  terms.byX[2] = hn::NegMulAdd(p[1], twice, terms.byX[2]);
  terms.byY[1] = hn::Add(terms.byY[1], twice);
  terms.byY[2] = hn::NegMulAdd(p[2], twice, terms.byY[2]);
  terms.amplitude = hn::Mul(p[0], p[0]);
  terms.twiceRoot = hn::Add(p[0], p[0]);
  const Vector sigmoid = hn::Div(one, hn::Add(one, exp2(hn::Mul(p[3], constant(-1.44269504f)))));
  const float logLargest = std::log2(largestExponent);
  const Vector exponent = exp2(hn::Mul(sigmoid, constant(logLargest)));
  terms.exponentLessOne = hn::Sub(exponent, one);
  terms.amplitudeTimesExponent = hn::Mul(terms.amplitude, exponent);
  const Vector bySigmoid = hn::Mul(exponent, constant(logLargest * 0.69314718f * 0.69314718f));
  terms.exponentByBend = hn::Mul(bySigmoid, hn::Mul(sigmoid, hn::Sub(one, sigmoid)));
  return terms;
}

HWY_INLINE Vector dot(const Vector* m, const glm::vec3& l) {
  return hn::MulAdd(m[0], constant(l.x), hn::MulAdd(m[1], constant(l.y), hn::Mul(m[2], constant(l.z))));
}

// One lobe's contribution to the residual of a light, and the four derivatives.
HWY_INLINE Vector lobeAt(const LobeTerms& terms, const glm::vec3& l, Vector scale, Vector* derivatives) {
  const Vector cosine = dot(terms.m, l);
  const Mask lit = hn::Gt(cosine, constant(1e-6f));
  const Vector safe = hn::IfThenElse(lit, cosine, constant(1.0f));
  const Vector logarithm = log2(safe);
  // The power less one gives both the value and its derivative without a division.
  const Vector lower =
      hn::IfThenElseZero(lit, hn::Mul(scale, exp2(hn::Mul(terms.exponentLessOne, logarithm))));
  const Vector power = hn::Mul(lower, safe);
  const Vector value = hn::Mul(terms.amplitude, power);
  const Vector byCosine = hn::Mul(terms.amplitudeTimesExponent, lower);
  derivatives[0] = hn::Mul(terms.twiceRoot, power);
  derivatives[1] = hn::Mul(byCosine, dot(terms.byX, l));
  derivatives[2] = hn::Mul(byCosine, dot(terms.byY, l));
  derivatives[3] = hn::Mul(value, hn::Mul(logarithm, terms.exponentByBend));
  return value;
}

// Rows and columns [row0, row1) x [column0, column1) of the lower triangle, summed over all lights
// in registers.
template <int N, int kRow0, int kRow1, int kColumn0, int kColumn1>
void addBlock(const float* derivatives, std::size_t lights, std::array<Vector, N*(N + 1) / 2>& matrix) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  constexpr int kRows = kRow1 - kRow0;
  constexpr int kColumns = kColumn1 - kColumn0;
  Vector sums[kRows][kColumns];
  for (auto& row : sums)
    for (Vector& sum : row) sum = hn::Zero(d);
  for (std::size_t i = 0; i < lights; ++i) {
    const float* light = derivatives + i * N * lanes;
    Vector columns[kColumns];
    for (int c = 0; c < kColumns; ++c)
      columns[c] = hn::Load(d, light + static_cast<std::size_t>(kColumn0 + c) * lanes);
    for (int r = 0; r < kRows; ++r) {
      const Vector row = hn::Load(d, light + static_cast<std::size_t>(kRow0 + r) * lanes);
      for (int c = 0; c < kColumns; ++c)
        if (kColumn0 + c <= kRow0 + r) sums[r][c] = hn::MulAdd(row, columns[c], sums[r][c]);
    }
  }
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c)
      if (kColumn0 + c <= kRow0 + r) {
        Vector& entry = matrix[static_cast<std::size_t>((kRow0 + r) * (kRow0 + r + 1) / 2 + kColumn0 + c)];
        entry = hn::Add(entry, sums[r][c]);
      }
}

// All blocks of four rows by four columns, which leave registers for the rest.
template <int N, int kRow0 = 0, int kColumn0 = 0>
void addBlocks(const float* derivatives, std::size_t lights, std::array<Vector, N*(N + 1) / 2>& matrix) {
  constexpr int kRow1 = std::min(kRow0 + 4, N);
  constexpr int kColumn1 = std::min(kColumn0 + 4, N);
  addBlock<N, kRow0, kRow1, kColumn0, kColumn1>(derivatives, lights, matrix);
  if constexpr (kColumn1 < kRow1)
    addBlocks<N, kRow0, kColumn1>(derivatives, lights, matrix);
  else if constexpr (kRow1 < N)
    addBlocks<N, kRow1, 0>(derivatives, lights, matrix);
}

// Solves (A + damping diag A) step = -gradient by LDL^T in every lane.
template <int N>
void solveStep(const NormalEquations<N>& equations, Vector damping, std::array<Vector, N>& step) {
  std::array<Vector, NormalEquations<N>::kTriangle> l;
  std::array<Vector, N> inverse;
  const auto at = [](int row, int column) { return static_cast<std::size_t>(row * (row + 1) / 2 + column); };
  for (int j = 0; j < N; ++j) {
    const Vector diagonal = equations.matrix[at(j, j)];
    Vector pivot = hn::Add(hn::MulAdd(damping, diagonal, diagonal), constant(1e-7f));
    std::array<Vector, N> scaled;
    for (int k = 0; k < j; ++k) {
      scaled[static_cast<std::size_t>(k)] = l[at(j, k)];
      l[at(j, k)] = hn::Mul(l[at(j, k)], inverse[static_cast<std::size_t>(k)]);
      pivot = hn::NegMulAdd(l[at(j, k)], scaled[static_cast<std::size_t>(k)], pivot);
    }
    inverse[static_cast<std::size_t>(j)] = hn::Div(constant(1.0f), hn::Max(pivot, constant(1e-12f)));
    for (int i = j + 1; i < N; ++i) {
      Vector value = equations.matrix[at(i, j)];
      for (int k = 0; k < j; ++k) value = hn::NegMulAdd(l[at(i, k)], l[at(j, k)], value);
      l[at(i, j)] = value;
    }
  }
  for (int j = 0; j < N; ++j) {
    Vector value = hn::Neg(equations.gradient[static_cast<std::size_t>(j)]);
    for (int k = 0; k < j; ++k) value = hn::NegMulAdd(l[at(j, k)], step[static_cast<std::size_t>(k)], value);
    step[static_cast<std::size_t>(j)] = value;
  }
  for (int j = N - 1; j >= 0; --j) {
    Vector value = hn::Mul(step[static_cast<std::size_t>(j)], inverse[static_cast<std::size_t>(j)]);
    for (int i = j + 1; i < N; ++i)
      value = hn::NegMulAdd(l[at(i, j)], step[static_cast<std::size_t>(i)], value);
    step[static_cast<std::size_t>(j)] = value;
  }
}

// Tried on synthetic and measured texels: 14 iterations a fit on average, and the lowest costs.
constexpr float kFirstDamping = 0.3f;
constexpr float kDampingWhenBetter = 0.4f;
constexpr float kDampingWhenWorse = 8.0f;
constexpr float kLargestDamping = 1e6f;
constexpr float kSmallestDamping = 1e-6f;
constexpr float kConverged = 2e-4f;  // relative decrease of the cost

// The jobs that the lanes work on; a lane is refilled when its job is done.
template <int K, bool kSolveDiffuse>
class Batch {
 public:
  Batch(const LobeProblem& problem, int iterations, std::span<LobeJob> jobs)
      : problem_(problem),
        jobs_(jobs),
        maximumIterations_(iterations),
        lights_(problem.lights.size()),
        lanes_(hn::Lanes(Tag())),
        floats_(
            hwy::AllocateAligned<float>(lanes_ * (2 * lights_ + kLightsAtOnce * N + 2 * kParameters + 4))),
        lane_(lanes_) {
    float* next = floats_.get();
    const auto take = [&](std::size_t vectors) { return std::exchange(next, next + vectors * lanes_); };
    targets_ = take(lights_);
    scales_ = take(lights_);
    derivatives_ = take(kLightsAtOnce * N);
    parameters_ = take(kParameters);
    trial_ = take(kParameters);
    damping_ = take(1);
    cost_ = take(1);
    decrease_ = take(1);
    diffuseSlope_ = take(1);
    std::fill(floats_.get(), next, 0.0f);
  }

  void run() {
    for (std::size_t lane = 0; lane < lanes_; ++lane) refill(lane);
    NormalEquations<N> current;
    current.matrix.fill(hn::Zero(Tag()));
    current.gradient.fill(hn::Zero(Tag()));
    current.cost = current.diffuseSlope = hn::Zero(Tag());
    while (active_ > 0) iterate(current);
  }

 private:
  // their derivatives stay in the first-level cache
  static constexpr std::size_t kLightsAtOnce = 16;
  static constexpr int kParameters = 4 * K + 1;
  static constexpr int N = 4 * K + (kSolveDiffuse ? 1 : 0);

  struct Lane {
    LobeJob* job = nullptr;
    int iterations = 0;
  };

  // Evaluates every lane at its trial point, keeps what is better, and makes the next trial points.
  void iterate(NormalEquations<N>& current) {
    const Tag d;
    NormalEquations<N> tried;
    evaluate(tried);
    const Vector oldCost = hn::Load(d, cost_);  // infinite for a fresh job
    const Mask better = hn::Lt(tried.cost, oldCost);
    current.takeFrom(tried, better);
    for (std::size_t k = 0; k < kParameters; ++k) {
      const Vector kept =
          hn::IfThenElse(better, hn::Load(d, trial_ + k * lanes_), hn::Load(d, parameters_ + k * lanes_));
      hn::Store(kept, d, parameters_ + k * lanes_);
    }
    hn::Store(hn::IfThenElse(better, tried.cost, oldCost), d, cost_);
    hn::Store(hn::IfThenElse(better, hn::Sub(oldCost, tried.cost), oldCost), d, decrease_);
    hn::Store(current.diffuseSlope, d, diffuseSlope_);
    const Vector damping = hn::Load(d, damping_);
    const Vector next = hn::IfThenElse(
        better, hn::Max(hn::Mul(damping, constant(kDampingWhenBetter)), constant(kSmallestDamping)),
        hn::Mul(damping, constant(kDampingWhenWorse)));
    hn::Store(next, d, damping_);

    std::array<Vector, N> step;
    solveStep<N>(current, next, step);
    for (std::size_t k = 0; k < N; ++k) {
      // A step of half the parabolic plane, or of half the range of exponents, is no step but a
      // leap.
      const Vector limit = constant(k % 4 == 3 ? 2.0f : 0.5f);
      const Vector bounded = hn::Min(hn::Max(step[k], hn::Neg(limit)), limit);
      hn::Store(hn::Add(hn::Load(d, parameters_ + k * lanes_), bounded), d, trial_ + k * lanes_);
    }
    for (std::size_t lane = 0; lane < lanes_; ++lane)
      if (lane_[lane].job && done(lane)) finish(lane), refill(lane);
  }

  bool done(std::size_t lane) {
    const bool converged = decrease_[lane] < kConverged * cost_[lane];
    return ++lane_[lane].iterations > maximumIterations_ || converged || damping_[lane] > kLargestDamping ||
           !(cost_[lane] < std::numeric_limits<float>::infinity());
  }

  void finish(std::size_t lane) {
    LobeJob& job = *lane_[lane].job;
    job.cost = cost_[lane];
    job.diffuseSlope = diffuseSlope_[lane];
    for (std::size_t k = 0; k < kParameters; ++k)
      if (std::isfinite(cost_[lane])) job.parameters[k] = parameters_[k * lanes_ + lane];
    lane_[lane].job = nullptr;
    --active_;
  }

  void refill(std::size_t lane) {
    if (nextJob_ == jobs_.size()) return;
    LobeJob& job = jobs_[nextJob_++];
    lane_[lane] = {&job, 0};
    ++active_;
    for (std::size_t i = 0; i < lights_; ++i) {
      targets_[i * lanes_ + lane] = job.weights[i] * job.luminance[i];
      scales_[i * lanes_ + lane] = job.weights[i] * problem_.cosines[i];
    }
    for (std::size_t k = 0; k < kParameters; ++k)
      trial_[k * lanes_ + lane] = parameters_[k * lanes_ + lane] = job.parameters[k];
    damping_[lane] = kFirstDamping;
    cost_[lane] = std::numeric_limits<float>::infinity();
  }

  void evaluate(NormalEquations<N>& equations) {
    const Tag d;
    std::array<Vector, kParameters> p;
    for (std::size_t k = 0; k < kParameters; ++k) p[k] = hn::Load(d, trial_ + k * lanes_);
    std::array<LobeTerms, K> terms;
    for (std::size_t j = 0; j < K; ++j) terms[j] = termsOf(&p[4 * j], problem_.largestExponent);
    const Vector diffuse = hn::Mul(p[4 * K], p[4 * K]);
    const Vector diffuseByRoot = hn::Add(p[4 * K], p[4 * K]);
    equations.gradient.fill(hn::Zero(d));
    equations.cost = equations.diffuseSlope = hn::Zero(d);
    equations.matrix.fill(hn::Zero(d));
    for (std::size_t first = 0; first < lights_; first += kLightsAtOnce) {
      const std::size_t last = std::min(first + kLightsAtOnce, lights_);
      for (std::size_t i = first; i < last; ++i) {
        const Vector scale = hn::Load(d, scales_ + i * lanes_);
        Vector residual = hn::MulSub(scale, diffuse, hn::Load(d, targets_ + i * lanes_));
        std::array<Vector, N> derivatives;
        for (std::size_t j = 0; j < K; ++j)
          residual = hn::Add(residual, lobeAt(terms[j], problem_.lights[i], scale, &derivatives[4 * j]));
        if constexpr (kSolveDiffuse) derivatives[4 * K] = hn::Mul(scale, diffuseByRoot);
        for (std::size_t k = 0; k < N; ++k) {
          hn::Store(derivatives[k], d, derivatives_ + ((i - first) * N + k) * lanes_);
          equations.gradient[k] = hn::MulAdd(derivatives[k], residual, equations.gradient[k]);
        }
        equations.cost = hn::MulAdd(residual, residual, equations.cost);
        equations.diffuseSlope = hn::MulAdd(scale, residual, equations.diffuseSlope);
      }
      addBlocks<N>(derivatives_, last - first, equations.matrix);
    }
  }

  const LobeProblem& problem_;
  std::span<LobeJob> jobs_;
  int maximumIterations_;
  std::size_t lights_;
  std::size_t lanes_;
  // all arrays below: a vector for each light or parameter
  hwy::AlignedFreeUniquePtr<float[]> floats_;
  float* targets_ = nullptr;      // weighted samples
  float* scales_ = nullptr;       // what the model is multiplied by: weight and cosine
  float* derivatives_ = nullptr;  // [light of kLightsAtOnce][unknown]
  float* parameters_ = nullptr;   // the best so far
  float* trial_ = nullptr;
  float* damping_ = nullptr;
  float* cost_ = nullptr;
  float* diffuseSlope_ = nullptr;
  float* decrease_ = nullptr;  // by the last step; the whole cost where it was refused
  std::vector<Lane> lane_;
  std::size_t nextJob_ = 0;
  std::size_t active_ = 0;
};

template <bool kSolveDiffuse>
void solveWith(const LobeProblem& problem, int lobes, int iterations, std::span<LobeJob> jobs) {
  if (lobes == 1) Batch<1, kSolveDiffuse>(problem, iterations, jobs).run();
  if (lobes == 2) Batch<2, kSolveDiffuse>(problem, iterations, jobs).run();
  if (lobes == 3) Batch<3, kSolveDiffuse>(problem, iterations, jobs).run();
  if (lobes == 4) Batch<4, kSolveDiffuse>(problem, iterations, jobs).run();
}

void solveLobesHere(const LobeProblem& problem, int lobes, bool solveDiffuse, int iterations,
                    std::span<LobeJob> jobs) {
  if (solveDiffuse)
    solveWith<true>(problem, lobes, iterations, jobs);
  else
    solveWith<false>(problem, lobes, iterations, jobs);
}

}  // namespace HWY_NAMESPACE
}  // namespace weft
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace weft {

HWY_EXPORT(solveLobesHere);

void solveLobes(const LobeProblem& problem, int lobes, DiffuseSolve diffuse, int iterations,
                std::span<LobeJob> jobs) {
  HWY_DYNAMIC_DISPATCH(solveLobesHere)(problem, lobes, diffuse == DiffuseSolve::Solve, iterations, jobs);
}

}  // namespace weft
#endif
