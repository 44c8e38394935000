// Tells whether numbers from outside can be used as a covariance.
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

namespace mrroc {

/// @tparam n  of variables  @param rows  n rows of n numbers
/// @return whether all are finite, and the matrix is symmetric to within 1e-6 of its deviations and positive definite.
///         Real-time safe
template <int n, std::size_t size>
[[nodiscard]] bool is_covariance(const std::array<double, size>& rows) noexcept {
  static_assert(size == static_cast<std::size_t>(n) * n);
  using Matrix = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
  const Eigen::Map<const Matrix> C(rows.data());
  if (!C.allFinite()) return false;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < r; ++c)
      if (!(std::abs(C(r, c) - C(c, r)) <= 1e-6 * std::sqrt(C(r, r)) * std::sqrt(C(c, c)))) return false;
  return Eigen::LLT<Matrix>(C).info() == Eigen::Success;
}

}  // namespace mrroc
