#include "Textons.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <random>

namespace weft {
namespace {

using TexelRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using TexelMap = Eigen::Map<const TexelRows>;

constexpr int kClusterRounds = 8;
constexpr Eigen::Index kAssignedTexels = 256;

/// Calls `work(first, count)` for batches of rows, on all threads.
template <class Work>
void forBatches(Eigen::Index rows, const Work& work) {
  tbb::parallel_for(Eigen::Index{0}, (rows + kAssignedTexels - 1) / kAssignedTexels, [&](Eigen::Index batch) {
    work(batch * kAssignedTexels, std::min(kAssignedTexels, rows - batch * kAssignedTexels));
  });
}

/// Each next centre is a texel that is drawn by its squared distance from those before.
TexelRows firstCentres(const TexelMap& texels, Eigen::Index wanted) {
  std::mt19937_64 random(1);
  Eigen::VectorXf nearest = Eigen::VectorXf::Constant(texels.rows(), std::numeric_limits<float>::max());
  TexelRows centres(wanted, texels.cols());
  Eigen::Index count = 0,
               next = static_cast<Eigen::Index>(random() % static_cast<std::uint64_t>(texels.rows()));
  while (true) {
    centres.row(count++) = texels.row(next);
    forBatches(texels.rows(), [&](Eigen::Index first, Eigen::Index size) {
      nearest.segment(first, size) =
          nearest.segment(first, size)
              .cwiseMin((texels.middleRows(first, size).rowwise() - centres.row(count - 1))
                            .rowwise()
                            .squaredNorm());
    });
    const double sum = nearest.cast<double>().sum();
    if (count == wanted || !(sum > 0.0)) break;
    double drawn = sum * (static_cast<double>(random() >> 11) * 0x1p-53);
    next = 0;
    while (next + 1 < texels.rows() && (drawn -= double{nearest[next]}) >= 0.0) ++next;
    // Rounding may lead to a texel that is a centre already.
    if (nearest[next] <= 0.0f) nearest.maxCoeff(&next);
  }
  centres.conservativeResize(count, Eigen::NoChange);
  return centres;
}

void assignTexels(const TexelMap& texels, const TexelRows& centres, std::vector<std::uint16_t>& ofTexel) {
  const Eigen::RowVectorXf norms = centres.rowwise().squaredNorm().transpose();
  forBatches(texels.rows(), [&](Eigen::Index first, Eigen::Index size) {
    TexelRows distances = -2.0f * (texels.middleRows(first, size) * centres.transpose());
    distances.rowwise() += norms;
    for (Eigen::Index i = 0; i < size; ++i) {
      Eigen::Index nearest = 0;
      distances.row(i).minCoeff(&nearest);
      ofTexel[static_cast<std::size_t>(first + i)] = static_cast<std::uint16_t>(nearest);
    }
  });
}

/// Centres without texels stay where they are.
void moveToMeans(const TexelMap& texels, const std::vector<std::uint16_t>& ofTexel, TexelRows& centres) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(centres.cols(), centres.rows());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(centres.rows());
  for (Eigen::Index i = 0; i < texels.rows(); ++i) {
    const std::uint16_t texton = ofTexel[static_cast<std::size_t>(i)];
    sums.col(texton) += texels.row(i).transpose().cast<double>();
    counts[texton] += 1.0;
  }
  for (Eigen::Index c = 0; c < centres.rows(); ++c)
    if (counts[c] > 0.0) centres.row(c) = (sums.col(c) / counts[c]).cast<float>().transpose();
}

std::vector<float> distancesOf(const TexelRows& centres) {
  const Eigen::VectorXf norms = centres.rowwise().squaredNorm();
  std::vector<float> result(static_cast<std::size_t>(centres.rows() * centres.rows()));
  Eigen::Map<TexelRows> distances(result.data(), centres.rows(), centres.rows());
  forBatches(centres.rows(), [&](Eigen::Index first, Eigen::Index size) {
    distances.middleRows(first, size).noalias() =
        -2.0f * (centres.middleRows(first, size) * centres.transpose());
    distances.middleRows(first, size).rowwise() += norms.transpose();
    distances.middleRows(first, size).colwise() += norms.segment(first, size);
    distances.middleRows(first, size) = distances.middleRows(first, size).cwiseMax(0.0f);
  });
  return result;
}

}  // namespace

Textons findTextons(const AppearanceVectors& vectors, int centres) {
  const Eigen::Index texels = Eigen::Index{vectors.width} * vectors.height;
  const TexelMap rows(vectors.values.data(), texels, vectors.dimensions);
  const Eigen::Index wanted = std::clamp<Eigen::Index>(centres, 1, std::min<Eigen::Index>(texels, 65535));
  TexelRows means = firstCentres(rows, wanted);
  Textons textons;
  textons.ofTexel.resize(static_cast<std::size_t>(texels));
  for (int round = 0; round < kClusterRounds; ++round) {
    assignTexels(rows, means, textons.ofTexel);
    moveToMeans(rows, textons.ofTexel, means);
  }
  assignTexels(rows, means, textons.ofTexel);
  textons.count = static_cast<int>(means.rows());
  textons.distances = distancesOf(means);
  return textons;
}

}  // namespace weft
