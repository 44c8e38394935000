// Integration of stiff models with the derivatives of the result: an implicit Runge-Kutta method of two equal stages.
#pragma once
#include <Eigen/LU>
#include <concepts>
#include <numbers>

namespace mrroc::ocp {

/// f(x, u, p) of a model x' = f with its derivatives.
template <int n_x, int n_u, int n_p>
struct Derivative {
  Eigen::Matrix<double, n_x, 1> f;      ///< x', in units of the model
  Eigen::Matrix<double, n_x, n_x> f_x;  ///< by the state
  Eigen::Matrix<double, n_x, n_u> f_u;  ///< by the controls
  Eigen::Matrix<double, n_x, n_p> f_p;  ///< by the parameters
};

/// State at the end of a time, and how it depends on the state at its beginning, on controls and on parameters.
template <int n_x, int n_u, int n_p>
struct Transition {
  Eigen::Matrix<double, n_x, 1> x;    ///< at the end, in units of the model
  Eigen::Matrix<double, n_x, n_x> A;  ///< derivative of x by the state at the beginning
  Eigen::Matrix<double, n_x, n_u> B;  ///< by the controls
  Eigen::Matrix<double, n_x, n_p> C;  ///< by the parameters
};

/// A model: sizes n_x, n_u, n_p, and derivative(x, u, p), which is real-time safe.
template <class M>
concept OdeModel = requires(const M& model, const Eigen::Matrix<double, M::n_x, 1>& x,
                            const Eigen::Matrix<double, M::n_u, 1>& u,
                            const Eigen::Matrix<double, M::n_p, 1>& p) {
  { model.derivative(x, u, p) }
  noexcept->std::same_as<Derivative<M::n_x, M::n_u, M::n_p>>;
};

/// Most Newton iterations of a stage.
inline constexpr int kNewtonIterations = 3;

namespace sdirk_detail {

/// gamma = 1 - 1 / sqrt(2) makes the method L-stable and of second order (Alexander, "Diagonally implicit Runge-Kutta
/// methods for stiff O.D.E.'s", 1977).
inline constexpr double kGamma = 1 - 1 / std::numbers::sqrt2;

/// Solves k = f(x + h gamma k) by Newton's method; L and d are those of the last iteration.
template <OdeModel M>
struct StageSolver {
  using Vector = Eigen::Matrix<double, M::n_x, 1>;
  using Matrix = Eigen::Matrix<double, M::n_x, M::n_x>;

  Vector k;
  Derivative<M::n_x, M::n_u, M::n_p> d;
  Eigen::PartialPivLU<Matrix> L;

  void solve(const M& model, const Vector& x, const Eigen::Matrix<double, M::n_u, 1>& u,
             const Eigen::Matrix<double, M::n_p, 1>& p, double h) noexcept {
    constexpr double kSmall = 1e-16;  // of the square of a correction
    for (int i = 0; i < kNewtonIterations; ++i) {
      d = model.derivative(x + h * kGamma * k, u, p);
      L.compute(Matrix::Identity() - h * kGamma * d.f_x);
      const Vector correction = L.solve(d.f - k);
      k += correction;
      if (correction.squaredNorm() < kSmall) break;
    }
  }

  /// Derivatives of k with respect to (x, u, p) at the beginning, by the implicit function theorem.
  /// @param S  those of the state that the stage starts from
  template <class Sensitivity>
  [[nodiscard]] Sensitivity sensitivity(const Sensitivity& S) const noexcept {
    Sensitivity right = d.f_x * S;
    right.template middleCols<M::n_u>(M::n_x) += d.f_u;
    right.template rightCols<M::n_p>() += d.f_p;
    return L.solve(right);
  }
};

}  // namespace sdirk_detail

/// Integrates a model over a time with constant u and p. Real-time safe: fixed sizes, bounded work.
/// @param h  [s], of one step  @param steps  equal ones, >= 1
/// @return the state after h * steps and its derivatives; where Newton's method does not converge, an approximation
template <OdeModel M>
[[nodiscard]] Transition<M::n_x, M::n_u, M::n_p> integrate(const M& model,
                                                           const Eigen::Matrix<double, M::n_x, 1>& x,
                                                           const Eigen::Matrix<double, M::n_u, 1>& u,
                                                           const Eigen::Matrix<double, M::n_p, 1>& p,
                                                           double h, int steps = 1) noexcept {
  using Vector = Eigen::Matrix<double, M::n_x, 1>;
  using Matrix = Eigen::Matrix<double, M::n_x, M::n_x>;
  using Sensitivity = Eigen::Matrix<double, M::n_x, M::n_x + M::n_u + M::n_p>;
  using sdirk_detail::kGamma;

  Vector end = x;
  Sensitivity S = Sensitivity::Zero();
  S.template leftCols<M::n_x>().setIdentity();
  sdirk_detail::StageSolver<M> first;
  sdirk_detail::StageSolver<M> second;
  // A linearly implicit step gives the first guess; later the last slope does.
  const Derivative<M::n_x, M::n_u, M::n_p> start = model.derivative(x, u, p);
  first.k = (Matrix::Identity() - h * kGamma * start.f_x).partialPivLu().solve(start.f);
  for (int i = 0; i < steps; ++i) {
    first.solve(model, end, u, p, h);
    second.k = first.k;
    second.solve(model, end + h * (1 - kGamma) * first.k, u, p, h);
    const Sensitivity S1 = first.sensitivity(S);
    const Sensitivity S2 = second.sensitivity(Sensitivity(S + h * (1 - kGamma) * S1));
    end += h * ((1 - kGamma) * first.k + kGamma * second.k);
    S += h * ((1 - kGamma) * S1 + kGamma * S2);
    first.k = second.k;
  }
  return {end, S.template leftCols<M::n_x>(), S.template middleCols<M::n_u>(M::n_x),
          S.template rightCols<M::n_p>()};
}

}  // namespace mrroc::ocp
