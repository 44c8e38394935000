// The model of Rex: its derivatives, its integration, what it conserves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "robots/rex/model.hpp"
#include "robots/rex/wheels.hpp"
#include "test/robots/rex/plant.hpp"

namespace mrroc::rex {
namespace {

struct Case {
  Load load;
  State x;
  Torques u;
  Friction p;
};

Case random_case(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Case c;
  c.load.mass = 40 + 6 * uniform(random);
  c.load.centre = {0.06 * uniform(random), 0.06 * uniform(random), 0};
  c.load.wheel = standing_load(c.load.mass, c.load.centre);
  c.x << 2 * uniform(random), 2 * uniform(random), 3 * uniform(random), uniform(random),
      0.3 * uniform(random), uniform(random), 0, 0, 0, 0;
  const PerWheel rolling = rolling_speeds(c.x[kVelocity], c.x[kTurnRate]);
  for (int i = 0; i < 4; ++i) c.x[kWheelSpeed + i] = rolling[static_cast<std::size_t>(i)] + uniform(random);
  c.u = Torques::NullaryExpr([&] { return 10 * uniform(random); });
  c.p << 0.65 + 0.3 * uniform(random), 0.65 + 0.3 * uniform(random), 0.4 * uniform(random);
  return c;
}

TEST(SkidSteer, DerivativesAreThoseOfItsFunction) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Case c = random_case(random);
    const SkidSteer model(c.load);
    const auto d = model.derivative(c.x, c.u, c.p);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < SkidSteer::n_x; ++k) {
      const State e = kStep * State::Unit(k);
      const State slope =
          (model.derivative(c.x + e, c.u, c.p).f - model.derivative(c.x - e, c.u, c.p).f) / (2 * kStep);
      EXPECT_LT((slope - d.f_x.col(k)).norm(), 1e-5 * (1 + slope.norm())) << k;
    }
    for (int k = 0; k < SkidSteer::n_u; ++k) {
      const Torques e = kStep * Torques::Unit(k);
      const State slope =
          (model.derivative(c.x, c.u + e, c.p).f - model.derivative(c.x, c.u - e, c.p).f) / (2 * kStep);
      EXPECT_LT((slope - d.f_u.col(k)).norm(), 1e-6);
    }
    for (int k = 0; k < SkidSteer::n_p; ++k) {
      const Friction e = kStep * Friction::Unit(k);
      const State slope =
          (model.derivative(c.x, c.u, c.p + e).f - model.derivative(c.x, c.u, c.p - e).f) / (2 * kStep);
      EXPECT_LT((slope - d.f_p.col(k)).norm(), 1e-5 * (1 + slope.norm()));
    }
  }
}

/// Runge-Kutta of fourth order in steps of 0.01 ms.
State exactly(const SkidSteer& model, State x, const Torques& u, const Friction& p, double duration) {
  constexpr double h = 1e-5;
  const auto f = [&](const State& at) { return model.derivative(at, u, p).f; };
  for (long i = 0; i < std::lround(duration / h); ++i) {
    const State k1 = f(x), k2 = f(x + h / 2 * k1), k3 = f(x + h / 2 * k2), k4 = f(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return x;
}

TEST(SkidSteer, IsIntegratedInStepsOf50MsAsInStepsOf10Us) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    Case c = random_case(random);
    c.u /= 2;
    const SkidSteer model(c.load);
    // Behind the first instants, in which speeds that do not belong together find each other.
    const State begin = exactly(model, c.x, c.u, c.p, 0.05);
    const State exact = exactly(model, begin, c.u, c.p, 0.05);
    const State x = ocp::integrate(model, begin, c.u, c.p, 0.05).x;
    EXPECT_LT((x - exact).head<3>().norm(), 2e-3) << i;
    EXPECT_LT((x - exact).segment<3>(kVelocity).norm(), 0.05) << i;
  }
}

TEST(SkidSteer, DerivativesOfItsIntegralAreThoseOfItsResult) {
  std::mt19937 random(3);
  int close = 0;
  for (int i = 0; i < 50; ++i) {
    const Case c = random_case(random);
    const SkidSteer model(c.load);
    const State x = exactly(model, c.x, c.u, c.p, 0.05);
    const auto t = ocp::integrate(model, x, c.u, c.p, 0.02);
    const Torques e = 1e-4 * Torques::Unit(i % 4);
    const State slope = (ocp::integrate(model, x, Torques(c.u + e), c.p, 0.02).x -
                         ocp::integrate(model, x, Torques(c.u - e), c.p, 0.02).x) /
                        2e-4;
    close += static_cast<int>((slope - t.B.col(i % 4)).norm() < 0.02 * slope.norm());
  }
  EXPECT_GE(close, 47);  // Newton's method ends before the last digit
}

TEST(SkidSteer, StandsWhereNothingDrivesIt) {
  const SkidSteer model({40, {0.02, 0.01, 0}, standing_load(40, {0.02, 0.01, 0})});
  EXPECT_EQ(model.derivative(State::Zero(), Torques::Zero(), Friction(0.7, 0.6, 0)).f, State::Zero());
}

TEST(SkidSteer, LeftAndRightAreMirrored) {
  std::mt19937 random(4);
  const auto mirrored = [](State x) {
    for (const int k : {1, 2, 4, 5}) x[k] = -x[k];
    std::swap(x[6], x[7]);
    std::swap(x[8], x[9]);
    return x;
  };
  for (int i = 0; i < 50; ++i) {
    Case c = random_case(random);
    const State f = SkidSteer(c.load).derivative(c.x, c.u, c.p).f;
    c.load.centre.y = -c.load.centre.y;
    std::swap(c.load.wheel[0], c.load.wheel[1]);
    std::swap(c.load.wheel[2], c.load.wheel[3]);
    const Torques u(c.u[1], c.u[0], c.u[3], c.u[2]);
    const Friction p(c.p[0], c.p[1], -c.p[2]);
    EXPECT_LT((SkidSteer(c.load).derivative(mirrored(c.x), u, p).f - mirrored(f)).norm(), 1e-9);
  }
}

TEST(SkidSteer, GoesTheWayOfAPlantOfItsStructure) {
  // Left wheels slower: a curve, mu and split as the plant has them.
  test::Truth truth{.centre_x = 0.03, .centre_y = 0.01, .friction = {0.5, 0.4, 0.2}};
  test::Plant plant(truth);
  const PlanarPose centre{truth.centre_x, truth.centre_y, 0};
  const SkidSteer model({truth.mass, centre, standing_load(truth.mass, centre)});
  State x = state_of({}, centre);
  const PerWheel torque{1, 7, 1, 7};
  for (int i = 0; i < 100; ++i) {
    plant.step(torque, kPlatformPeriod);
    x = ocp::integrate(model, x, Torques(Torques::Map(torque.data())), friction_of(truth.friction),
                       kPlatformPeriod)
            .x;
  }
  const PlanarPose p = pose_of(x, centre);
  EXPECT_GT(p.phi, 0.15);
  EXPECT_NEAR(p.x, plant.p().x, 0.01);
  EXPECT_NEAR(p.y, plant.p().y, 0.01);
  EXPECT_NEAR(p.phi, plant.p().phi, 0.01);
  EXPECT_NEAR(velocity_of(x, centre).vx, plant.v().vx, 0.01);
}

TEST(StandingLoad, HoldsTheWeightAndItsMoments) {
  const PlanarPose centre{0.05, -0.03, 0};
  const PerWheel load = standing_load(42, centre);
  double sum = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    sum += load[i];
    x += load[i] * kWheelX[i];
    y += load[i] * kWheelY[i];
  }
  EXPECT_NEAR(sum, 42 * kGravity, 1e-9);
  EXPECT_NEAR(x / sum, centre.x, 1e-12);
  EXPECT_NEAR(y / sum, centre.y, 1e-12);
}

TEST(State, OfTheMassCentreBelongsToThatOfB) {
  const PlanarPose centre{0.05, -0.03, 0};
  PlatformEstimate estimate{.p = {1, 2, 0.7}, .v = {0.5, 0.1, 0.8}, .theta_dot = {1, 2, 3, 4}};
  const State x = state_of(estimate, centre);
  const PlanarPose p = pose_of(x, centre);
  const PlanarVelocity v = velocity_of(x, centre);
  EXPECT_NEAR(p.x, 1, 1e-12);
  EXPECT_NEAR(p.y, 2, 1e-12);
  EXPECT_EQ(p.phi, 0.7);
  EXPECT_NEAR(v.vx, 0.5, 1e-12);
  EXPECT_NEAR(v.vy, 0.1, 1e-12);
  EXPECT_EQ(v.w, 0.8);
  EXPECT_NEAR(std::hypot(x[0] - 1, x[1] - 2), std::hypot(centre.x, centre.y), 1e-12);
  // The mass centre's own velocity is the change of its place.
  constexpr double kTime = 1e-6;
  estimate.p = {1 + kTime * (0.5 * std::cos(0.7) - 0.1 * std::sin(0.7)),
                2 + kTime * (0.5 * std::sin(0.7) + 0.1 * std::cos(0.7)), 0.7 + kTime * 0.8};
  const State later = state_of(estimate, centre);
  const double c = std::cos(0.7), s = std::sin(0.7);
  EXPECT_NEAR((later[0] - x[0]) / kTime, c * x[3] - s * x[4], 1e-5);
  EXPECT_NEAR((later[1] - x[1]) / kTime, s * x[3] + c * x[4], 1e-5);
}

TEST(Wheels, RollWithTheBody) {
  const PerWheel speed = rolling_speeds(0.6, 1);
  EXPECT_NEAR(speed[0], (0.6 - 0.3) / 0.15, 1e-12);  // left wheels are inside of a turn to the left
  EXPECT_EQ(speed[0], speed[2]);
  EXPECT_NEAR(speed[1], (0.6 + 0.3) / 0.15, 1e-12);
  EXPECT_EQ(speed[1], speed[3]);
}

TEST(Wheels, DrivesGiveTheirTorqueUpToASpeedAndBrakeWithAllOfIt) {
  EXPECT_EQ(torque_range(0).upper, kMaxTorque);
  EXPECT_EQ(torque_range(0).lower, -kMaxTorque);
  EXPECT_EQ(torque_range(kFullTorqueSpeed).upper, kMaxTorque);
  EXPECT_EQ(torque_range(kMaxWheelSpeed).upper, 0);
  EXPECT_EQ(torque_range(100).upper, 0);
  EXPECT_EQ(torque_range(100).lower, -kMaxTorque);
  for (double speed = -20; speed <= 20; speed += 0.5) {
    EXPECT_EQ(torque_range(speed).upper, -torque_range(-speed).lower);
    EXPECT_LE(torque_range(speed + 0.1).upper, torque_range(speed).upper);
  }
}

TEST(Wheels, TorquesBeyondTheLimitAreTakenToItAndAllOthersStay) {
  const double beyond = std::nextafter(kMaxTorque, 100.);
  EXPECT_EQ(within_limit({beyond, -beyond, kMaxTorque, -kMaxTorque}),
            (PerWheel{kMaxTorque, -kMaxTorque, kMaxTorque, -kMaxTorque}));
  EXPECT_EQ(within_limit({1e9, -1e9, 0, 7}), (PerWheel{kMaxTorque, -kMaxTorque, 0, 7}));
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    PerWheel torque{1, -2, 3, -4};
    PerWheel wanted = torque;
    torque[wheel] = 2 * kMaxTorque;
    wanted[wheel] = kMaxTorque;
    EXPECT_EQ(within_limit(torque), wanted) << "each wheel by itself: " << wheel;
  }
}

}  // namespace
}  // namespace mrroc::rex
