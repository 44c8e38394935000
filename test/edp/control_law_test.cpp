// Law (28) against its closed forms, MG 8.1.3.
#include "edp/control_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;

constexpr bool near(double a, double b, double tolerance) { return a - b <= tolerance && b - a <= tolerance; }

// (31): in UNGUARDED motion the computed velocity is the desired one, whatever the force and the past.
static_assert(axis_velocity(u(0.1), 50, -0.3, kDt) == 0.1);
// 8.1.2: that also holds when the row carries what UNGUARDED motion does not have (B = 0).
static_assert(axis_velocity({Behaviour::unguarded, 7, 0.1, 20, 0.005}, 50, -0.3, kDt) == 0.1);
// (32): without inertia CONTACT is damping control, v = B (F_d - F_a).
static_assert(near(axis_velocity(c(3, 0, 0.005), 1, 9, kDt), 0.005 * 2, 1e-16));
// 8.1.2: CONTACT has no desired velocity, GUARDED motion no desired force.
static_assert(axis_velocity({Behaviour::contact, 3, 0.7, 20, 0.005}, 1, 0.1, kDt) ==
              axis_velocity(c(3, 20, 0.005), 1, 0.1, kDt));
static_assert(axis_velocity({Behaviour::guarded, 9, 0.01, 20, 0.005}, 1, 0.1, kDt) ==
              axis_velocity(g(0.01, 20, 0.005), 1, 0.1, kDt));
// (37) and (38) differ from each other by the desired velocity only.
static_assert(near(axis_velocity(g(0.01, 20, 0.005), 1, 0.1, kDt) -
                       axis_velocity(c(0, 20, 0.005), 1, 0.1, kDt),
                   0.01 * kDt / (kDt + 0.1), 1e-16));
// Tab. 4 (a): a guarded approach settles at v/B = 0.01 / 0.0025 = 4 N, whatever it pushes against.
static_assert(near(settled_force(g(0.01, 5, 0.0025)), 4, 1e-15));
static_assert(near(settle(g(0.01, 5, 0.0025), 8'000), 4, 1e-3));
static_assert(near(settle(g(0.01, 5, 0.0025), 20'000), 4, 1e-3));
// CONTACT settles at the desired force.
static_assert(near(settle(c(1, 20, 0.005), 10'000), 1, 1e-3));
// No axis has an effect on another one.
static_assert(step_velocity({u(), c(1, 20, 0.005), u(), u(), u(0.2), u()}, {{9, 0, 9, 9, 9, 9}}, {}, kDt) ==
              Twist{{0, 0.005 * kDt / (kDt + 0.1), 0, 0, 0.2, 0}});

struct Row {
  double I, B;
};
Row random_row(std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-3, 0);
  return {100 * std::pow(10, exponent(random)), std::pow(10, exponent(random) - 1)};
}

// A mass I with a damper 1/B under the error of the force, and v_d of the damper's other end: I dv/dt = F_d - F_a +
// (v_d - v) / B, the force of a sample and the velocity of the next one.
TEST(ControlLaw, IsTheMotionOfADampedMass) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise;
  for (int run = 0; run < 200; ++run) {
    const auto [I, B] = random_row(random);
    const double F_d = 5 * noise(random), v_d = 0.1 * noise(random);
    double v = 0, guarded = 0;
    for (int k = 0; k < 100; ++k) {
      const double F_a = 5 * noise(random);
      const double before = v, guarded_before = guarded;
      v = axis_velocity(c(F_d, I, B), F_a, v, kDt);
      guarded = axis_velocity(g(v_d, I, B), F_a, guarded, kDt);
      ASSERT_NEAR(I * (v - before) / kDt, F_d - F_a - v / B, 1e-9);
      ASSERT_NEAR(I * (guarded - guarded_before) / kDt, -F_a + (v_d - guarded) / B, 1e-9);
    }
  }
}

// G(z) = B dt / (B I (1 - 1/z) + dt) of the force error, eq. (34), by its impulse response.
TEST(ControlLaw, IsTheDiscretisedTransmittanceOneSampleLate) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise;
  for (int run = 0; run < 20; ++run) {
    const auto [I, B] = random_row(random);
    const double pole = 1 / (1 + kDt / (B * I));
    std::vector<double> error;
    double v = 0;
    for (int k = 0; k < 200; ++k) {
      const double F_d = 5 * noise(random), F_a = 5 * noise(random);
      error.push_back(F_d - F_a);
      v = axis_velocity(c(F_d, I, B), F_a, v, kDt);
      double sum = 0;
      for (int n = 0; n <= k; ++n)
        sum += B * (1 - pole) * std::pow(pole, k - n) * error[static_cast<std::size_t>(n)];
      ASSERT_NEAR(v, sum, 1e-12 * (1 + std::abs(sum)));
    }
  }
}

TEST(ControlLaw, FreeMotionUnderAConstantForceErrorTendsToBTimesIt) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 200; ++run) {
    const auto [I, B] = random_row(random);
    const double BI = B * I;
    double v = 0;
    double pole_to_k = 1;
    for (int k = 1; k <= 2000; ++k) {
      v = axis_velocity(c(2, I, B), 0, v, kDt);
      pole_to_k *= BI / (BI + kDt);
      ASSERT_NEAR(v, 2 * B * (1 - pole_to_k), 1e-12);
    }
  }
}

TEST(ControlLaw, TimeConstantIsBTimesI) {
  const double BI = 0.005 * 20;
  double v = 0;
  const int k = static_cast<int>(BI / 1e-5);
  for (int n = 0; n < k; ++n) v = axis_velocity(c(1, 20, 0.005), 0, v, 1e-5);
  EXPECT_NEAR(v / 0.005, 1 - std::exp(-1), 1e-4);
}

TEST(ControlLaw, SettlesAtItsForceOnEverySpringThatItIsDampedOn) {
  // Damping ratio 1 / (2 B sqrt(K I)) of an ideal plant; one sample of delay costs little when it is high.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> damping(0.4, 2);
  for (int run = 0; run < 300; ++run) {
    const auto [I, B] = random_row(random);
    const double zeta = damping(random);
    const double K = 1 / (4 * B * B * I * zeta * zeta);
    const double frequency = std::sqrt(K / I);
    if (frequency * kDt > 0.1) continue;
    const int steps = static_cast<int>(60 / (frequency * kDt * std::min(1., zeta)));
    EXPECT_NEAR(settle(c(1.5, I, B), K, kDt, steps), 1.5, 1e-3);
    const double v = 0.01;
    EXPECT_NEAR(settle(g(v, I, B), K, kDt, steps) / settled_force(g(v, I, B)), 1, 1e-3);
  }
}

TEST(ControlLaw, IsLinearInForceVelocityAndPast) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise;
  for (int run = 0; run < 10'000; ++run) {
    const auto [I, B] = random_row(random);
    const double F1 = noise(random), F2 = noise(random), v1 = noise(random), v2 = noise(random);
    const double sum = axis_velocity(c(0, I, B), F1 + F2, v1 + v2, kDt);
    ASSERT_NEAR(sum, axis_velocity(c(0, I, B), F1, v1, kDt) + axis_velocity(c(0, I, B), F2, v2, kDt), 1e-12);
  }
}

TEST(ControlLaw, GuardedMotionWithoutMobilityIgnoresTheForce) {
  EXPECT_EQ(axis_velocity(g(0.03, 20, 0), 1000, 5, kDt), 0.03);
  EXPECT_EQ(settled_force(g(0.03, 20, 0)), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace mrroc::edp
