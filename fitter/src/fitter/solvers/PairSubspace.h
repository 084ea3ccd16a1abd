#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace weft {

/// Orthonormal columns, numbers a pair, that span `first` and nearly the strongest components of
/// the values of some texels, `[texel][pair]`: at most `most` of these, fewer where there are fewer
/// texels or pairs. A randomised range finder (Halko, Martinsson, Tropp: *Finding structure with
/// randomness*, 2011). Equal input gives equal columns.
Eigen::MatrixXf pairSubspace(std::span<const float> values, std::span<const float> first, std::size_t most);

/// The eigenvectors of the largest eigenvalues of a symmetric matrix, the largest first; zeros
/// instead of those that rounding makes.
Eigen::MatrixXd strongestEigenvectors(const Eigen::MatrixXd& matrix, std::size_t count);

}  // namespace weft
