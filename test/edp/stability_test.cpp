#include "edp/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include "base/fault.hpp"
#include "robots/irb6/parameters.hpp"
#include "test/edp/contact_simulation.hpp"

namespace mrroc::edp {
namespace {

ContactLoop loop_of(double I, double B, const ServoModel& servo = LagServo{}) {
  ContactLoop l;
  l.inertia = I;
  l.mobility = B;
  l.servo = servo;
  return l;
}

TEST(Stability, IdealServoHasTheLimitOfTheClosedFormula) {
  // v(k+1) = a v(k) - b F(k), F(k) = K x(k): z^2 - (1 + a - b K dt) z + a = 0, stable for K < 2 (1 + a) / (b dt).
  for (const double I : {0.5, 5., 20.})
    for (const double B : {0.0025, 0.005, 0.025})
      for (const double dt : {0.001, 0.002, 0.004}) {
        ContactLoop l = loop_of(I, B, IdealServo{});
        l.dt = dt;
        l.mean_of_step = false;
        const double a = B * I / (dt + B * I), b = B * dt / (dt + B * I);
        const double limit = 2 * (1 + a) / (b * dt);
        EXPECT_NEAR(stiffness_limit(l) / limit, 1, 1e-4);
      }
}

// With damping D K of the surroundings and the mean force of a step, F(k) = K (x(k) - v(k) dt/2 + D v(k)). The map of x
// and v has the determinant alpha = a - b K (D - dt/2) and the trace 1 - b K dt + alpha; where D is more than half a
// step it is stable for K < (1 + a) / (b D).
TEST(Stability, DampedSurroundingsHaveTheLimitOfTheClosedFormula) {
  for (const double I : {0.5, 5.})
    for (const double D : {0.004, 0.01}) {
      ContactLoop l = loop_of(I, 0.005, IdealServo{});
      l.mean_of_step = true;
      l.contact_damping = D;
      const double BI = l.mobility * I;
      const double a = BI / (l.dt + BI), b = l.mobility * l.dt / (l.dt + BI);
      EXPECT_NEAR(stiffness_limit(l) / ((1 + a) / (b * D)), 1, 1e-3) << I << ' ' << D;
    }
}

TEST(Stability, WithAShortStepTheDampingRatioIsThatOfThePaper) {
  for (const double K : {1e3, 1e4, 1e5}) {
    ContactLoop l = loop_of(20, 0.005, IdealServo{});
    l.dt = 1e-6;
    EXPECT_NEAR(contact_mode(l, K).damping, std::min(1.0, 1 / (2 * 0.005 * std::sqrt(K * 20))), 2e-3);
  }
}

TEST(Stability, FiguresOfTheServoStudyComeBack) {
  // Limits in N/m for servos of 8, 12, 20 and 30 Hz (double pole, velocity feed-forward), the force one step
  // late: they were computed with a servo of its own, shorter step.
  struct Row {
    double I, B;
    std::array<double, 4> limit;
  };
  constexpr std::array kRows{Row{5, 0.0025, {3.9e4, 4.9e4, 6.9e4, 9.4e4}},
                             Row{20, 0.005, {2.0e4, 3.1e4, 5.5e4, 8.2e4}},
                             Row{0.5, 0.025, {3.9e3, 4.9e3, 6.9e3, 9.4e3}}};
  constexpr std::array kBandwidths{8., 12., 20., 30.};
  for (const Row& row : kRows)
    for (std::size_t k = 0; k < kBandwidths.size(); ++k) {
      ContactLoop l = loop_of(row.I, row.B, LagServo{kBandwidths[k]});
      l.delay = 1;
      l.mean_of_step = false;
      EXPECT_NEAR(stiffness_limit(l) / row.limit[k], 1, 0.2) << row.I << " kg, " << kBandwidths[k] << " Hz";
    }
}

TEST(Stability, PredictedLimitIsThatOfTheTimeDomain) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 25; ++run) {
    const ContactLoop l = test::random_loop(random);
    const double limit = stiffness_limit(l);
    if (limit == 0 || limit > 1e8) continue;
    EXPECT_FALSE(test::ContactSimulation(l, 0.95 * limit).unstable()) << "run " << run;
    EXPECT_TRUE(test::ContactSimulation(l, 1.05 * limit).unstable()) << "run " << run;
  }
}

/// @return the upper arm's drive with its standard regulator, pressing with a pen
CompensatedDrive upper_arm() {
  const AxisProperties& axis = irb6::kPostument.axes[2].properties;
  return {.regulator = axis.servo.compensating[0],
          .model = axis.servo.drive,
          .increments_per_rad = axis.increments_per_rad,
          .inertia = axis.servo.drive.inertia,
          .lever = 0.67 / 172};
}

/// @param make  a loop, of a random generator and the number of the run
template <class Make>
void expect_limits_of_the_time_domain(std::uint64_t seed, int runs, Make make) {
  std::mt19937_64 random(seed);
  int judged = 0;
  for (int run = 0; run < runs; ++run) {
    const ContactLoop l = make(random, run);
    const double limit = stiffness_limit(l);
    if (limit == 0 || limit > 1e7) continue;
    ++judged;
    EXPECT_FALSE(test::ContactSimulation(l, 0.9 * limit).unstable()) << "run " << run;
    EXPECT_TRUE(test::ContactSimulation(l, 1.1 * limit).unstable()) << "run " << run;
  }
  EXPECT_GT(judged, 10);
}

TEST(Stability, PredictedLimitOfTheCompensatingRegulatorIsThatOfTheTimeDomain) {
  expect_limits_of_the_time_domain(
      1, 40, [](auto& random, int /*run*/) { return test::random_loop(random, upper_arm()); });
}

TEST(Stability, PredictedLimitWithElasticGearsIsThatOfTheTimeDomain) {
  expect_limits_of_the_time_domain(3, 30, [](auto& random, int run) {
    return test::elastic(random,
                         run % 2 == 0 ? test::random_loop(random) : test::random_loop(random, upper_arm()));
  });
}

TEST(Stability, StiffGearsAreAsRigidOnes) {
  for (const ServoModel& servo : {ServoModel(LagServo{}), ServoModel(upper_arm())}) {
    ContactLoop l = loop_of(5, 0.0025, servo);
    const ContactMode rigid = contact_mode(l, 5e3);
    l.gears = {100, 0.03, 10, 0};
    EXPECT_NEAR(contact_mode(l, 5e3).radius, rigid.radius, 2e-3);
  }
}

/// An arm of one joint that is the upper arm's drive, with a rotor and links of these inertias at the shaft.
WholeArm arm_of_one_joint(const CompensatedDrive& d, double rotor, double tool) {
  const auto one = [](double x) { return AxisVector(AxisVector::Constant(1, x)); };
  WholeArm arm;
  arm.drives = {{d.regulator, d.model, d.increments_per_rad, rotor}};
  arm.motors_per_joints = AxisMatrix::Constant(1, 1, 1 / d.lever);  // the joint is the way of the tip
  arm.mass = AxisMatrix::Constant(1, 1, (d.inertia - rotor) / (d.lever * d.lever));
  arm.tip = arm.set = arm.tool_centre = one(1);
  arm.tool = tool;
  arm.wheels = 0;
  return arm;
}

TEST(Stability, AnArmOfOneJointIsItsDrive) {
  const CompensatedDrive drive = upper_arm();
  for (const double B : {0.0025, 0.01})
    EXPECT_NEAR(stiffness_limit(loop_of(5, B, arm_of_one_joint(drive, drive.inertia / 2, 0))) /
                    stiffness_limit(loop_of(5, B, drive)),
                1, 1e-3);
}

TEST(Stability, AnArmOfOneJointWithElasticGearsIsItsDriveBehindAMode) {
  const CompensatedDrive drive = upper_arm();
  const double rotor = drive.inertia / 2;
  for (const double tool : {0., 1.2}) {
    ContactLoop one = loop_of(5, 0.0025, drive);
    one.gears = {10, 0.03, rotor / (drive.lever * drive.lever), tool};
    ContactLoop arm = loop_of(5, 0.0025, arm_of_one_joint(drive, rotor, tool));
    arm.gears.frequency = 10;
    for (const double K : {1e3, 1e4, 1e5}) {
      EXPECT_NEAR(contact_mode(arm, K).radius, contact_mode(one, K).radius, 1e-6) << K;
      EXPECT_NEAR(contact_mode(arm, K).damping, contact_mode(one, K).damping, 1e-4) << K;
    }
  }
}

TEST(Stability, AnArmWhoseMatricesDoNotFitItsDrivesIsRefused) {
  WholeArm arm = arm_of_one_joint(upper_arm(), upper_arm().inertia / 2, 0);
  arm.mass = AxisMatrix::Identity(2, 2);
  EXPECT_THROW(static_cast<void>(stiffness_limit(loop_of(5, 0.0025, arm))), FaultError);
}

TEST(Stability, GearsSofterThanTheLimitBearAnyContactButRingInIt) {
  ContactLoop l = loop_of(20, 0.005);
  const double rigid_limit = stiffness_limit(l), rigid_damping = contact_mode(l, 1e4).damping;
  l.gears = {10, 0.03, 10};
  const double omega = 2 * std::numbers::pi * l.gears.frequency;
  ASSERT_LT(l.gears.mass * omega * omega, rigid_limit) << "no servo feels more than the spring of its gears";
  EXPECT_EQ(stiffness_limit(l), std::numeric_limits<double>::infinity());
  EXPECT_LT(contact_mode(l, 1e4).damping, rigid_damping / 4);
}

TEST(Stability, ModeOfGearsIsThatOfTheLinksBetweenTheirSpringAndTheContact) {
  ContactLoop l = loop_of(20, 1e-6);  // a servo that hardly moves
  l.gears = {10, 0.03, 10};
  const double own = 2 * std::numbers::pi * 10;
  EXPECT_NEAR(contact_mode(l, 1e4).frequency, std::sqrt(own * own + 1e4 / 10) / (2 * std::numbers::pi), 0.1);
}

TEST(Stability, InertiaOfTheToolIsMeasuredWithoutContact) {
  ContactLoop l = loop_of(1, 0.02);
  l.gears = {10, 0.01, 10, 0};
  const double without = contact_mode(l, 0).damping;
  EXPECT_NEAR(without, 0.01, 1e-4);
  l.gears.tool = 1;
  EXPECT_GT(std::abs(contact_mode(l, 0).damping - without), 0.01);
}

/// @return the drive of an axis with its original regulator, pressing with a pen
RegulatedDrive original_drive(std::size_t axis, double lever) {
  const AxisProperties& a = irb6::kPostument.axes[axis].properties;
  return {.regulator = a.servo.incremental[0],
          .increments_per_rad = a.increments_per_rad,
          .speed_gain = a.servo.drive.speed_per_pwm(),
          .time_constant = a.servo.drive.time_constant(),
          .inertia = a.servo.drive.inertia,
          .lever = lever};
}

TEST(Stability, PredictedLimitOfTheOriginalRegulatorIsThatOfTheTimeDomain) {
  std::mt19937_64 random(1);
  int judged = 0;
  for (int run = 0; run < 30; ++run) {
    const double lever = (run % 2 == 0 ? 1 : -1) * 0.6 / 160;
    const ContactLoop l = test::random_loop(random, original_drive(run % 4, lever));
    const double limit = stiffness_limit(l);
    if (limit == 0 || limit > 1e7) continue;
    ++judged;
    EXPECT_FALSE(test::ContactSimulation(l, 0.95 * limit).unstable()) << "run " << run;
    EXPECT_TRUE(test::ContactSimulation(l, 1.05 * limit).unstable()) << "run " << run;
  }
  EXPECT_GT(judged, 10);
}

/// @return whether the mode that swings longest is also the one that decays most slowly
bool swings_longest(const ContactMode& m, double dt) {
  if (m.frequency <= 0) return false;
  const double natural = 2 * std::numbers::pi * m.frequency / std::sqrt(1 - m.damping * m.damping);
  return std::abs(std::log(m.radius) + m.damping * natural * dt) < 1e-6 * natural * dt;
}

// A push excites what swings; a slow mode that does not may be hardly there, and then the push decays faster.
TEST(Stability, WhatIsLeftOfAPushDecaysAsPredictedWhereItSwingsAndNeverMoreSlowly) {
  std::mt19937_64 random(2);
  for (const int kind : {0, 1, 2}) {
    int swinging = 0, others = 0;
    for (int run = 0; run < 40; ++run) {
      const ContactLoop l = kind == 0   ? test::random_loop(random)
                            : kind == 1 ? test::random_loop(random, upper_arm())
                                        : test::random_loop(random, original_drive(run % 4, 0.6 / 160));
      const double limit = stiffness_limit(l);
      if (limit == 0 || limit > 1e7) continue;
      const double K = limit * std::uniform_real_distribution<>(0.85, 0.97)(random);
      const ContactMode mode = contact_mode(l, K);
      const double rate = std::log(mode.radius);
      const double measured = std::log(test::ContactSimulation(l, K).decay(-7 / rate)) / rate;
      EXPECT_GT(measured, 0.97) << "kind of servo " << kind << ", run " << run;
      if (swings_longest(mode, l.dt)) {
        EXPECT_LT(measured, 1.03) << "kind of servo " << kind << ", run " << run;
      }
      ++(swings_longest(mode, l.dt) ? swinging : others);
    }
    EXPECT_GT(swinging, 8) << "kind of servo " << kind << ", " << others << " others";
  }
}

TEST(Stability, CompensatedDriveFollowsWithoutContact) {
  EXPECT_LE(contact_mode(loop_of(20, 0.005, upper_arm()), 0).radius, 1 + 1e-9);
  EXPECT_GT(contact_mode(loop_of(20, 0.005, upper_arm()), 1e3).damping, 0.5) << "as an ideal servo does";
  CompensatedDrive no_drive = upper_arm();
  no_drive.lever = 0;
  EXPECT_THROW((void)stiffness_limit(loop_of(20, 0.005, no_drive)), FaultError);
}

TEST(Stability, WhatDelaysTheForceCostsStiffness) {
  const ContactLoop l = loop_of(5, 0.0025);
  const double limit = stiffness_limit(l);
  ContactLoop late = l, averaged = l, filtered = l, slow = l;
  late.delay = 2;
  averaged.average = 4;
  filtered.low_pass = 30;
  slow.servo = LagServo{8};
  for (const ContactLoop& worse : {late, averaged, filtered, slow})
    EXPECT_LT(stiffness_limit(worse), 0.95 * limit);
}

TEST(Stability, LessMobilityAllowsStifferContact) {
  double before = 0;
  for (const double B : {0.02, 0.01, 0.005, 0.0025, 0.001}) {
    const double limit = stiffness_limit(loop_of(5, B));
    EXPECT_GT(limit, before);
    before = limit;
  }
}

TEST(Stability, MobilityForADampingRatioGivesIt) {
  for (const double K : {3e3, 1e4, 5e4}) {
    const ContactLoop l = loop_of(5, 0.01);
    ContactLoop damped = l;
    damped.mobility = mobility_for(l, K, 0.5);
    ASSERT_GT(damped.mobility, 0);
    EXPECT_NEAR(contact_mode(damped, K).damping, 0.5, 1e-2);
    EXPECT_GT(stiffness_limit(damped), K);
  }
}

TEST(Stability, MobilityForADampingRatioIsTheGreatestThatGivesIt) {
  ContactLoop l = loop_of(5, 0.01);
  l.mobility = mobility_for(l, 1e4, 0.5);
  EXPECT_GE(contact_mode(l, 1e4).damping, 0.5);
  l.mobility *= 1.0003;
  EXPECT_LT(contact_mode(l, 1e4).damping, 0.5);
  EXPECT_EQ(mobility_for(l, 1e4, 1.01), 0) << "no loop is damped more than one that does not swing";
}

TEST(Stability, FrequencyIsThatOfTheMassOnItsSpring) {
  ContactLoop l = loop_of(20, 0.005, IdealServo{});
  l.dt = 1e-6;
  for (const double K : {1e4, 1e5}) {
    const double zeta = 1 / (2 * 0.005 * std::sqrt(K * 20));
    EXPECT_NEAR(contact_mode(l, K).frequency, std::sqrt(K / 20 * (1 - zeta * zeta)) / (2 * std::numbers::pi),
                1e-3);
  }
}

TEST(Stability, StiffnessLiesBetweenNoneAndTheStiffest) {
  const ContactLoop l = loop_of(5, 0.005);
  for (const double good : {0., 1e9}) EXPECT_NO_THROW(static_cast<void>(contact_mode(l, good))) << good;
  for (const double wrong : {-1e-9, 1.001e9})
    EXPECT_THROW(static_cast<void>(contact_mode(l, wrong)), FaultError) << wrong;
}

TEST(Stability, ParametersThatMakeNoSenseAreRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const ContactLoop& l, const std::string& name) {
    try {
      static_cast<void>(stiffness_limit(l));
    } catch (const FaultError& e) {
      return e.fault().code == FaultCode::out_of_limits &&
             std::string(e.what()).find(name) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused(loop_of(nan, 0.005), "I "));
  EXPECT_TRUE(refused(loop_of(-1, 0.005), "I "));
  EXPECT_TRUE(refused(loop_of(5, 0), "B "));
  const auto changed = [](auto change) {
    ContactLoop l = loop_of(5, 0.005);
    change(l);
    return l;
  };
  for (const double D : {-1e-9, 1 + 1e-9, nan})
    EXPECT_TRUE(refused(changed([&](ContactLoop& l) { l.contact_damping = D; }), "contact damping")) << D;
  for (const int delay : {-1, 21})
    EXPECT_TRUE(refused(changed([&](ContactLoop& l) { l.delay = delay; }), "delay")) << delay;
  for (const int average : {0, 21})
    EXPECT_TRUE(refused(changed([&](ContactLoop& l) { l.average = average; }), "average")) << average;
  for (const double dt : {0.0, 0.1001, nan})
    EXPECT_TRUE(refused(changed([&](ContactLoop& l) { l.dt = dt; }), "dt")) << dt;
  EXPECT_TRUE(refused(changed([](ContactLoop& l) { l.low_pass = -1e-9; }), "low pass"));
  EXPECT_TRUE(refused(loop_of(5, 1001), "B "));
  EXPECT_TRUE(refused(loop_of(1.1e6, 0.005), "I "));
  for (const GearMode& gears : {GearMode{-1}, GearMode{101}, GearMode{nan}, GearMode{10, -0.1},
                                GearMode{10, 0.03, 0}, GearMode{10, 0.03, 1, 1.1}})
    EXPECT_TRUE(refused(changed([&](ContactLoop& l) { l.gears = gears; }), "gears"));
  EXPECT_TRUE(refused(changed([](ContactLoop& l) {
                        l.servo = upper_arm();
                        l.gears = {10, 0.03, 1e3};
                      }),
                      "rotor"));
  EXPECT_TRUE(refused(loop_of(5, 0.005, LagServo{nan}), "bandwidth"));
  EXPECT_TRUE(refused(loop_of(5, 0.005, LagServo{20, 3}), "order"));
  EXPECT_TRUE(refused(loop_of(5, 0.005, RegulatedDrive{}), "drive"));
  EXPECT_THROW(static_cast<void>(contact_mode(loop_of(5, 0.005), nan)), FaultError);
}

}  // namespace
}  // namespace mrroc::edp
