// Quadratic programmes with the structure of optimal control: what a tracker and an estimator solve in every iteration.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

namespace mrroc::ocp {

/// A matrix or a vector of somebody else, column by column: nothing is copied, nothing is allocated. Empty where there is
/// nothing to give.
struct View {
  const double* data{};  ///< not owned; null where there is nothing to give
  Eigen::Index rows{};   ///< of the matrix; a vector's size
  Eigen::Index cols{};   ///< of the matrix; 1 of a vector

  View() noexcept = default;
  /// @param m  a matrix or vector, not an expression; it must live as long as the view
  template <class Derived>
  View(const Eigen::PlainObjectBase<Derived>& m) noexcept  // NOLINT: what is seen is the matrix itself
      : data(m.data()), rows(m.rows()), cols(m.cols()) {
    static_assert(!Derived::IsRowMajor || Derived::IsVectorAtCompileTime, "column by column");
  }
};

/// Sizes of one stage, and which of its controls have bounds.
struct Stage {
  int n_x{};                     ///< states; 0 in the first stage: its state is known and is part of b
  int n_u{};                     ///< controls; 0 in the last stage
  std::vector<int> bounded_u{};  ///< controls with bounds, ascending indices
};

/// How solve() has ended.
enum class QpStatus {
  solved,      ///< within 1e-6 of what the conditions of optimality demand
  not_solved,  ///< too many iterations, steps too short, numbers that are not finite, or not a convex problem
  bad_data,    ///< a size did not fit, or an index was wrong
};

/// Result of solve().
struct QpResult {
  QpStatus status{QpStatus::not_solved};
  int iterations{};  ///< of the interior point method

  [[nodiscard]] bool ok() const noexcept { return status == QpStatus::solved; }
};

/// The problem, over stages k = 0..N,
///
///     min  sum_k 1/2 x_k' Q_k x_k + u_k' S_k x_k + 1/2 u_k' R_k u_k + q_k' x_k + r_k' u_k
///     with x_(k+1) = A_k x_k + B_k u_k + b_k   and bounds of u_k,
///
/// solved by HPIPM (Frison and Diehl, "HPIPM: a high-performance quadratic programming framework for model predictive
/// control", 2020) in its robust mode. All memory is taken by the constructor; all other functions are real-time safe. What
/// has been set stays until it is set again; at first all numbers are 0. A size or an index that does not fit is remembered,
/// and makes the next solve() answer bad_data.
class OcpQp {
 public:
  /// @param stages      0..N, at least two  @param iterations  most of the interior point method, >= 1
  /// @throws std::invalid_argument  of sizes or indices that cannot be, or that HPIPM does not solve rightly
  OcpQp(std::span<const Stage> stages, int iterations);
  ~OcpQp();
  OcpQp(OcpQp&&) noexcept;
  OcpQp& operator=(OcpQp&&) noexcept;
  OcpQp(const OcpQp&) = delete;
  OcpQp& operator=(const OcpQp&) = delete;

  /// x_(k+1) = A x_k + B u_k + b, 0 <= k < N.
  /// @param A  n_x of k+1 by n_x of k  @param B  n_x of k+1 by n_u of k  @param b  n_x of k+1
  void dynamics(int k, View A, View B, View b) noexcept;
  /// Price of stage k; what is empty stays as it is. The Hessian [R S; S' Q] is to be positive semidefinite, R definite.
  /// @param Q  n_x by n_x, symmetric  @param S  n_u by n_x  @param R  n_u by n_u, symmetric  @param q  n_x  @param r  n_u
  void cost(int k, View Q, View S, View R, View q, View r) noexcept;
  /// @param lower, upper  of the bounded controls, in the order of Stage::bounded_u; finite, lower <= upper
  void bounds_u(int k, View lower, View upper) noexcept;

  /// Solves it from the beginning: the same data give the same bits, whatever was solved before.
  [[nodiscard]] QpResult solve() noexcept;

  /// What the last solve() has found; it means something only if that was ok.
  /// @param out  its size is n_u of k  @return false: the size is another one, or there is no such k; out is as it was
  template <class Derived>
  bool u(int k, Eigen::PlainObjectBase<Derived>& out) const noexcept {
    return control(k, out.data(), out.size());
  }
  /// @param out  its size is n_x of k  @return false: the size is another one, or there is no such k; out is as it was
  template <class Derived>
  bool x(int k, Eigen::PlainObjectBase<Derived>& out) const noexcept {
    return state(k, out.data(), out.size());
  }

 private:
  struct Solver;

  bool control(int k, double* out, Eigen::Index size) const noexcept;
  bool state(int k, double* out, Eigen::Index size) const noexcept;

  std::unique_ptr<Solver> solver_;
};

}  // namespace mrroc::ocp
