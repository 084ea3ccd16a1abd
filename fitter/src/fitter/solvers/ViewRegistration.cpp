#include "solvers/ViewRegistration.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <random>
#include <span>
#include <utility>

#include "weft/core/Contract.h"

namespace weft {
namespace {

constexpr float kLowestHeight = -4.0f;
constexpr float kGreatestHeight = 8.0f;
constexpr float kHeightStep = 0.5f;
constexpr int kCorrection = 2;  // texels that a view may differ from what the height predicts
constexpr int kRounds = 4;
constexpr Eigen::Index kComponents = 12;
constexpr std::size_t kRegisteredTexels = 4000;
// What a shift has to gain of the energy that is not captured: of all views, and of one.
constexpr double kHeightGain = 0.01;
constexpr double kViewGain = 0.01;

using Offsets = std::vector<glm::ivec2>;

glm::ivec2 predictedOffset(glm::vec3 view, float height) {
  const float lowestZ = 0.05f;  // no view is measured so low, and none is shifted without end
  const glm::vec2 shift = height / std::max(view.z, lowestZ) * glm::vec2(view.x, view.y);
  return {static_cast<int>(std::round(shift.x)), static_cast<int>(std::round(shift.y))};
}

Offsets predictedOffsets(std::span<const glm::vec3> views, float height) {
  Offsets offsets;
  for (glm::vec3 view : views) offsets.push_back(predictedOffset(view, height));
  return offsets;
}

int wrapped(int i, int size) {
  return (i % size + size) % size;
}

// The part of a window that is looked at, and some of its texels.
class Texels {
 public:
  Texels(const LuminanceWindow& window, int margin) : window_(window) {
    const int border = window.wraps ? 0 : margin;
    std::vector<glm::ivec2> all;
    for (int row = border; row < window.height - border; ++row)
      for (int column = border; column < window.width - border; ++column) all.emplace_back(column, row);
    // Its numbers are the same everywhere, those of distributions are not.
    std::mt19937 random(20032);
    const std::size_t count = std::min(kRegisteredTexels, all.size());
    for (std::size_t i = 0; i < count; ++i) {
      std::swap(all[i], all[i + random() % (all.size() - i)]);
      texels_.push_back(all[i]);
    }
  }

  Eigen::Index count() const { return static_cast<Eigen::Index>(texels_.size()); }

  // What a view shows of the texels, if it is shifted so: a row a texel, a column a light.
  void readView(std::size_t view, glm::ivec2 offset, Eigen::Ref<Eigen::MatrixXf> out) const {
    for (Eigen::Index i = 0; i < count(); ++i) {
      const glm::ivec2 texel = texels_[static_cast<std::size_t>(i)];
      const int column = wrapped(texel.x - offset.x, window_.width);
      const int row = wrapped(texel.y + offset.y, window_.height);
      const auto lights = static_cast<std::size_t>(window_.lights);
      const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.width) +
                                static_cast<std::size_t>(column);
      const std::uint8_t* values = window_.values.data() + (pixel * window_.views.size() + view) * lights;
      for (Eigen::Index light = 0; light < window_.lights; ++light)
        out(i, light) = static_cast<float>(values[light]) / 255.0f;
    }
  }

  // All views: a row a texel, a column a view and light.
  Eigen::MatrixXf read(const Offsets& offsets) const {
    Eigen::MatrixXf values(count(), static_cast<Eigen::Index>(offsets.size()) * window_.lights);
    for (std::size_t view = 0; view < offsets.size(); ++view)
      readView(view, offsets[view],
               values.middleCols(static_cast<Eigen::Index>(view) * window_.lights, window_.lights));
    return values;
  }

 private:
  const LuminanceWindow& window_;
  std::vector<glm::ivec2> texels_;
};

Eigen::MatrixXf orthonormalWeights(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> decomposition(columns);
  return decomposition.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

// Orthonormal weights of texels that capture most of the values (subspace iteration).
Eigen::MatrixXf strongestWeights(const Eigen::MatrixXf& values) {
  constexpr Eigen::Index extra = 6;  // what randomised subspaces need beyond the rank
  const Eigen::Index count = std::min({kComponents + extra, values.rows(), values.cols()});
  std::mt19937 random(20033);
  Eigen::MatrixXf columns = Eigen::MatrixXf::NullaryExpr(
      values.cols(), count, [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; });
  Eigen::MatrixXf weights;
  for (int iteration = 0; iteration < 3; ++iteration) {
    weights = orthonormalWeights(values * columns);
    columns = values.transpose() * weights;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver((columns.transpose() * columns).cast<double>());
  return weights * solver.eigenvectors().rightCols(std::min(kComponents, count)).cast<float>();
}

double energyOf(const Eigen::MatrixXf& values) {
  return values.colwise().squaredNorm().cast<double>().sum();
}

// The share of the energy that orthonormal weights do not capture; what is less than the rounding
// of bytes counts as nothing.
double restOf(const Eigen::MatrixXf& weights, const Eigen::MatrixXf& values) {
  constexpr double nothing = 1e-6;
  const double energy = energyOf(values);
  if (!(energy > 0.0)) return nothing;
  return std::max(1.0 - energyOf(weights.transpose() * values) / energy, nothing);
}

std::vector<double> restsOf(const Texels& texels, std::span<const glm::vec3> views,
                            std::span<const float> heights) {
  std::vector<double> rests(heights.size());
  tbb::parallel_for(std::size_t{0}, heights.size(), [&](std::size_t i) {
    const Eigen::MatrixXf values = texels.read(predictedOffsets(views, heights[i]));
    rests[i] = restOf(strongestWeights(values), values);
  });
  return rests;
}

// The heights whose shifts leave texels to look at, or tell a shift from the one around the back.
std::vector<float> candidateHeights(const LuminanceWindow& window) {
  const int size = std::min(window.width, window.height);
  const int room = (window.wraps ? size / 2 : size * 3 / 8) - kCorrection;
  std::vector<float> heights;
  for (float height = kLowestHeight; height <= kGreatestHeight; height += kHeightStep) {
    int largest = 0;
    for (glm::ivec2 offset : predictedOffsets(window.views, height))
      largest = std::max({largest, std::abs(offset.x), std::abs(offset.y)});
    if (largest <= room) heights.push_back(height);
  }
  return heights;
}

int largestShift(const LuminanceWindow& window, std::span<const float> heights) {
  int largest = 0;
  for (float height : heights)
    for (glm::ivec2 offset : predictedOffsets(window.views, height))
      largest = std::max({largest, std::abs(offset.x), std::abs(offset.y)});
  return largest + kCorrection;
}

float bestHeight(const Texels& texels, std::span<const glm::vec3> views, std::span<const float> heights) {
  const std::vector<double> rests = restsOf(texels, views, heights);
  const auto best = std::min_element(rests.begin(), rests.end()) - rests.begin();
  const auto none = std::find(heights.begin(), heights.end(), 0.0f) - heights.begin();
  const bool gains =
      rests[static_cast<std::size_t>(best)] < (1.0 - kHeightGain) * rests[static_cast<std::size_t>(none)];
  return gains ? heights[static_cast<std::size_t>(best)] : 0.0f;
}

// The shift around the predicted one with which the weights capture most of a view; the one it has
// unless another is clearly better.
glm::ivec2 bestOffset(const Texels& texels, const Eigen::MatrixXf& weights, std::size_t view, int lights,
                      glm::ivec2 predicted, glm::ivec2 current) {
  Eigen::MatrixXf values(texels.count(), lights);
  const auto restAt = [&](glm::ivec2 offset) {
    texels.readView(view, offset, values);
    return restOf(weights, values);
  };
  glm::ivec2 best = current;
  double least = (1.0 - kViewGain) * restAt(current);
  for (int y = -kCorrection; y <= kCorrection; ++y)
    for (int x = -kCorrection; x <= kCorrection; ++x) {
      const double rest = restAt(predicted + glm::ivec2(x, y));
      if (rest < least) least = rest, best = predicted + glm::ivec2(x, y);
    }
  return best;
}

std::size_t viewNearestToPole(std::span<const glm::vec3> views) {
  const auto higher = [](glm::vec3 a, glm::vec3 b) { return a.z < b.z; };
  return static_cast<std::size_t>(std::max_element(views.begin(), views.end(), higher) - views.begin());
}

Offsets corrected(const Texels& texels, const LuminanceWindow& window, const Offsets& predicted) {
  const std::size_t fixed = viewNearestToPole(window.views);
  Offsets offsets = predicted;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXf weights = strongestWeights(texels.read(offsets));
    Offsets next = offsets;
    tbb::parallel_for(std::size_t{0}, offsets.size(), [&](std::size_t view) {
      if (view != fixed)
        next[view] = bestOffset(texels, weights, view, window.lights, predicted[view], offsets[view]);
    });
    if (next == offsets) break;
    offsets = next;
  }
  return offsets;
}

}  // namespace

ViewShifts registerViews(const LuminanceWindow& window) {
  const std::size_t pixels = static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
  WEFT_EXPECT(window.values.size() == pixels * window.views.size() * static_cast<std::size_t>(window.lights),
              "a window has all values of its pixels");
  ViewShifts result;
  result.offsets.assign(window.views.size(), glm::ivec2(0));
  const std::vector<float> heights = candidateHeights(window);
  if (window.views.size() < 2 || window.lights == 0 || heights.empty()) return result;
  const Texels texels(window, largestShift(window, heights));
  if (texels.count() == 0) return result;
  result.height = bestHeight(texels, window.views, heights);
  result.offsets = corrected(texels, window, predictedOffsets(window.views, result.height));
  return result;
}

}  // namespace weft
