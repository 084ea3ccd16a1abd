#include "TexelValues.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace weft {
namespace {

using ValueRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t kTrainingTexels = 1024;
constexpr double kKeptVariance = 0.995;
constexpr Eigen::Index kMostDimensions = 96;
constexpr double kWarnedVariance = 0.9;
/// Texels that are projected together.
constexpr Eigen::Index kProjectedTexels = 64;

struct Axes {
  Eigen::RowVectorXf mean;
  ValueRows axes;  // `[value][dimension]`, orthonormal
};

std::span<float> rowOf(ValueRows& rows, Eigen::Index row) {
  return {rows.data() + row * rows.cols(), static_cast<std::size_t>(rows.cols())};
}

/// Calls `work(first, rows)` for all rows of texels, once they are loaded.
template <class Work>
Result<void> forLoadedRows(TexelValues& values, const Work& work) {
  const int atOnce = std::clamp(values.rowsAtOnce(), 1, values.height());
  for (int first = 0; first < values.height(); first += atOnce) {
    const int rows = std::min(atOnce, values.height() - first);
    // What was loaded for the first pass need not be loaded again where it is all.
    WEFT_TRY_VOID(values.load(first, rows));
    work(first, rows);
  }
  return {};
}

Result<ValueRows> trainingRows(TexelValues& values) {
  const std::size_t texels =
      static_cast<std::size_t>(values.width()) * static_cast<std::size_t>(values.height());
  const std::size_t count = std::min(texels, kTrainingTexels);
  ValueRows rows(static_cast<Eigen::Index>(count), values.count());
  WEFT_TRY_VOID(forLoadedRows(values, [&](int first, int loaded) {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const std::size_t texel = (2 * i + 1) * texels / (2 * count);
      const int y = static_cast<int>(texel / static_cast<std::size_t>(values.width()));
      const int x = static_cast<int>(texel % static_cast<std::size_t>(values.width()));
      if (y >= first && y < first + loaded) values.read(x, y, rowOf(rows, static_cast<Eigen::Index>(i)));
    });
  }));
  return rows;
}

/// Products of all pairs of rows, or of columns where there are fewer.
Eigen::MatrixXf gramMatrix(const ValueRows& rows, bool ofRows) {
  const Eigen::Index count = ofRows ? rows.rows() : rows.cols();
  Eigen::MatrixXf products(count, count);
  tbb::parallel_for(
      Eigen::Index{0}, (count + kProjectedTexels - 1) / kProjectedTexels, [&](Eigen::Index batch) {
        const Eigen::Index first = batch * kProjectedTexels, size = std::min(kProjectedTexels, count - first);
        if (ofRows)
          products.middleCols(first, size).noalias() = rows * rows.middleRows(first, size).transpose();
        else
          products.middleCols(first, size).noalias() = rows.transpose() * rows.middleCols(first, size);
      });
  return products;
}

Axes principalAxes(ValueRows rows) {
  Axes result;
  result.mean = rows.colwise().mean();
  rows.rowwise() -= result.mean;
  const bool ofRows = rows.rows() < rows.cols();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gramMatrix(rows, ofRows).cast<double>());
  const Eigen::VectorXd variances = solver.eigenvalues().reverse().cwiseMax(0.0);
  const double enough = kKeptVariance * variances.sum();
  Eigen::Index kept = 0;
  for (double sum = 0.0; kept < std::min(kMostDimensions, variances.size()) && sum < enough; ++kept)
    sum += variances[kept];
  kept = std::max<Eigen::Index>(kept, 1);
  const Eigen::MatrixXf vectors = solver.eigenvectors().rightCols(kept).rowwise().reverse().cast<float>();
  result.axes = ofRows ? ValueRows(rows.transpose() * vectors) : ValueRows(vectors);
  for (Eigen::Index i = 0; i < kept; ++i)
    if (const float length = result.axes.col(i).norm(); length > 0.0f) result.axes.col(i) /= length;
  return result;
}

struct Variance {
  double all = 0.0, kept = 0.0;
};

/// Projects `size` texels of a row from `x` on.
Variance projectTexels(const TexelValues& values, const Axes& axes, int x, int y, int size, float* out) {
  ValueRows rows(size, values.count());
  for (int i = 0; i < size; ++i) values.read(x + i, y, rowOf(rows, i));
  rows.rowwise() -= axes.mean;
  Eigen::Map<ValueRows> projected(out, size, axes.axes.cols());
  projected.noalias() = rows * axes.axes;
  const Variance variance{rows.squaredNorm(), projected.squaredNorm()};
  projected /= std::sqrt(static_cast<float>(values.count()));
  return variance;
}

}  // namespace

Result<AppearanceSample> principalAppearance(TexelValues& values, const Progress& progress) {
  WEFT_TRY(ValueRows training, trainingRows(values));
  if (progress) progress(0.4);
  const Axes axes = principalAxes(std::move(training));
  if (progress) progress(0.5);
  AppearanceSample sample;
  sample.vectors = {values.width(), values.height(), static_cast<int>(axes.axes.cols()), {}};
  const int width = values.width(),
            batches = (width + static_cast<int>(kProjectedTexels) - 1) / static_cast<int>(kProjectedTexels);
  sample.vectors.values.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(values.height()) *
                               static_cast<std::size_t>(axes.axes.cols()));
  std::vector<Variance> variances(static_cast<std::size_t>(values.height() * batches));
  WEFT_TRY_VOID(forLoadedRows(values, [&](int first, int rows) {
    tbb::parallel_for(first * batches, (first + rows) * batches, [&](int i) {
      const int x = i % batches * static_cast<int>(kProjectedTexels), y = i / batches;
      variances[static_cast<std::size_t>(i)] =
          projectTexels(values, axes, x, y, std::min(static_cast<int>(kProjectedTexels), width - x),
                        sample.vectors.at(x, y));
    });
    if (progress) progress(0.5 + 0.5 * (first + rows) / values.height());
  }));
  Variance sum;
  for (const Variance& v : variances) sum = {sum.all + v.all, sum.kept + v.kept};
  if (sum.all > 0.0) sample.keptVariance = std::min(sum.kept / sum.all, 1.0);
  if (sample.keptVariance < kWarnedVariance)
    sample.warnings.push_back(fmt::format(
        "{} numbers a texel keep {:.0f} % of the variance of the images: noise, or a sample in which "
        "everything differs",
        sample.vectors.dimensions, 100.0 * sample.keptVariance));
  return sample;
}

}  // namespace weft
