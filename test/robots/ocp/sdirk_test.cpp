// The stiff integrator, on models whose solutions are known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "robots/ocp/sdirk.hpp"

namespace mrroc::ocp {
namespace {

using Vector2 = Eigen::Matrix<double, 2, 1>;
using Vector1 = Eigen::Matrix<double, 1, 1>;

/// x' = K x + (u, 0) + (0, p), linear.
struct Linear {
  static constexpr int n_x = 2;
  static constexpr int n_u = 1;
  static constexpr int n_p = 1;
  Eigen::Matrix2d K;

  [[nodiscard]] Derivative<2, 1, 1> derivative(const Vector2& x, const Vector1& u,
                                               const Vector1& p) const noexcept {
    return {K * x + Vector2(u[0], p[0]), K, Vector2(1, 0), Vector2(0, 1)};
  }
};

/// x1' = p x2 + u, x2' = -sin x1 - x2: a damped pendulum.
struct Pendulum {
  static constexpr int n_x = 2;
  static constexpr int n_u = 1;
  static constexpr int n_p = 1;

  [[nodiscard]] Derivative<2, 1, 1> derivative(const Vector2& x, const Vector1& u,
                                               const Vector1& p) const noexcept {
    Derivative<2, 1, 1> d;
    d.f << p[0] * x[1] + u[0], -std::sin(x[0]) - x[1];
    d.f_x << 0, p[0], -std::cos(x[0]), -1;
    d.f_u << 1, 0;
    d.f_p << x[1], 0;
    return d;
  }
};

TEST(Sdirk, IsOfSecondOrder) {
  const Vector2 x(1, 0.3);
  const auto end = [&](int steps) {
    return integrate(Pendulum{}, x, Vector1(0.2), Vector1(1.3), 1. / steps, steps).x;
  };
  const Vector2 exact = end(4000);
  const double coarse = (end(10) - exact).norm();
  const double fine = (end(20) - exact).norm();
  EXPECT_NEAR(coarse / fine, 4, 0.4);
  EXPECT_LT(fine, 1e-3);
}

TEST(Sdirk, IsStableHoweverStiffTheModelIs) {
  for (const double stiffness : {1e2, 1e4, 1e8}) {
    const Linear model{(Eigen::Matrix2d() << -stiffness, 0, 0, -1).finished()};
    const auto t = integrate(model, Vector2(1, 1), Vector1(0), Vector1(0), 0.05);
    EXPECT_LT(std::abs(t.x[0]), 0.5) << stiffness;
    EXPECT_NEAR(t.x[1], std::exp(-0.05), 1e-5);
  }
  // L-stable: what is infinitely stiff is gone after one step.
  const Linear model{(Eigen::Matrix2d() << -1e12, 0, 0, -1).finished()};
  EXPECT_NEAR(integrate(model, Vector2(1, 1), Vector1(0), Vector1(0), 0.05).x[0], 0, 1e-9);
}

TEST(Sdirk, RestsWhereTheModelRests) {
  const auto t = integrate(Pendulum{}, Vector2::Zero(), Vector1(0), Vector1(1), 0.5);
  EXPECT_EQ(t.x, Vector2::Zero());
}

TEST(Sdirk, DerivativesAreThoseOfItsResult) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Vector2 x(3 * uniform(random), uniform(random));
    const Vector1 u(uniform(random));
    const Vector1 p(1 + 0.5 * uniform(random));
    const auto run = [](const Vector2& a, const Vector1& b, const Vector1& c) {
      return integrate(Pendulum{}, a, b, c, 0.1, 2);
    };
    const auto t = run(x, u, p);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 2; ++k) {
      const Vector2 d = kStep * Vector2::Unit(k);
      EXPECT_NEAR(((run(x + d, u, p).x - run(x - d, u, p).x) / (2 * kStep) - t.A.col(k)).norm(), 0, 1e-6);
    }
    const Vector1 d(kStep);
    EXPECT_NEAR(((run(x, u + d, p).x - run(x, u - d, p).x) / (2 * kStep) - t.B).norm(), 0, 1e-6);
    EXPECT_NEAR(((run(x, u, p + d).x - run(x, u, p - d).x) / (2 * kStep) - t.C).norm(), 0, 1e-6);
  }
}

}  // namespace
}  // namespace mrroc::ocp
