#include "sim/elastic_gears.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "test/sim/pressing_arm.hpp"

namespace mrroc::sim {
namespace {

using std::numbers::pi;

constexpr double kStepLength = 0.001;  // [s]
constexpr double kGear = 100;

/// A link of its own behind one elastic gear, without weight.
struct OneLink {
  static constexpr double kMass = 2;  // [kg m^2]
  explicit OneLink(const ElasticityParameters& p)
      : gears(p, {AxisVector::Zero(1), AxisMatrix::Constant(1, 1, kMass), AxisVector::Zero(1)}, motors, gear,
              kStepLength) {}

  static constexpr std::array kMotor{MotorParameters{.rotor_inertia = 1.5e-4, .brake_torque = 0.6}};
  std::span<const MotorParameters> motors{kMotor};
  AxisMatrix gear = AxisMatrix::Constant(1, 1, kGear);
  ElasticGears gears;
  double q{}, speed{};

  /// @param push  on the link [N m] @param torque  on the shaft [N m]
  void step(double push, double torque, bool braked) {
    const AxisVector given = gears.step(AxisVector::Constant(1, q), AxisVector::Constant(1, speed),
                                        AxisVector::Constant(1, torque), braked, gear);
    speed += kStepLength * (given[0] + push) / kMass;
    q += kStepLength * speed;
  }
  [[nodiscard]] double energy() const {
    const double rotor = (1 - kGearShare) * kMotor[0].rotor_inertia;
    const double w = gears.shaft_speeds()[0], stretch = gears.joints()[0] - q;
    return (kMass * speed * speed + rotor * w * w + gears.stiffness()[0] * stretch * stretch) / 2;
  }
};

/// @return frequency of the swings about their mean [Hz]
double frequency_of(const std::vector<double>& x, double dt) {
  double mean = 0;
  for (const double each : x) mean += each / static_cast<double>(x.size());
  double first = -1, last = -1;
  int crossings = -1;
  for (std::size_t k = 1; k < x.size(); ++k) {
    if (!(x[k - 1] < mean && x[k] >= mean)) continue;
    last = static_cast<double>(k) - (x[k] - mean) / (x[k] - x[k - 1]);
    if (first < 0) first = last;
    ++crossings;
  }
  return crossings / ((last - first) * dt);
}

WorldParameters elastic_world(double frequency, double damping = 0.03) {
  WorldParameters w = PressingArm::world_of_one();
  w.arms[0].elasticity = {frequency, damping};
  return w;
}

TEST(ElasticGears, LinkGivesWayByTorqueOverStiffness) {
  OneLink link({10, 0.2});
  constexpr double kPush = 50;  // [N m], less than the brake holds
  for (int k = 0; k < 5000; ++k) link.step(kPush, 0, true);
  EXPECT_NEAR(link.q * link.gears.stiffness()[0], kPush, 1e-6);
  EXPECT_EQ(link.gears.joints()[0], 0) << "the brake holds the rotor";
}

TEST(ElasticGears, BrakeSlipsBeyondItsTorque) {
  OneLink link({10, 0.2});
  for (int k = 0; k < 2000; ++k) link.step(1.2 * kGear * 0.6, 0, true);
  EXPECT_GT(link.gears.joints()[0], 0.1);
}

TEST(ElasticGears, TorqueOfTheMotorReachesTheLink) {
  OneLink link({10, 0.2});
  for (int k = 0; k < 4000; ++k) link.step(0, 1e-3, false);
  const double all = OneLink::kMass + (1 - kGearShare) * 1.5e-4 * kGear * kGear;
  EXPECT_NEAR(link.speed, 4000 * kStepLength * 1e-3 * kGear / all, 1e-3 * link.speed);
}

TEST(ElasticGears, EnergyOfFreeSwingsDoesNotGrow) {
  for (const double frequency : {5., 12., 40.}) {
    OneLink link({frequency, 0});
    link.q = 0.01;
    double most = 0;
    for (int k = 0; k < 1000; ++k) {
      link.step(0, 0, false);
      most = std::max(most, link.energy());
    }
    for (int k = 0; k < 200'000; ++k) {
      link.step(0, 0, false);
      ASSERT_LE(link.energy(), most * (1 + 1e-5)) << frequency << " Hz, step " << k;
    }
  }
}

TEST(ElasticGears, DampingOfTheHeldLinkIsTheOneGiven) {
  OneLink link({10, 0.05});
  link.q = 0.01;
  const double before = link.energy();
  const int steps = 1000;
  for (int k = 0; k < steps; ++k) link.step(0, 0, true);
  EXPECT_NEAR(std::log(before / link.energy()) / (2 * 2 * pi * 10 * steps * kStepLength), 0.05, 0.003);
}

TEST(ElasticGears, WhatMakesNoSenseIsRefused) {
  EXPECT_THROW(OneLink({-1, 0.03}), std::invalid_argument);
  EXPECT_THROW(OneLink({10, 1.1}), std::invalid_argument);
  EXPECT_THROW(OneLink({300, 0.03}), std::invalid_argument) << "faster than the integration follows";
}

TEST(ElasticArm, LowestModeHasTheFrequencyGiven) {
  for (const double frequency : {5., 8., 15., 40.}) {
    World world(elastic_world(frequency, 0.01));
    HardwareCommand shove{.enabled = true};
    shove.pwm[0] = 15;
    for (int k = 0; k < 10; ++k) world.step({&shove, 1});
    for (int k = 0; k < 200; ++k) world.step({});  // brakes close: rotors are held
    std::vector<double> column;
    for (int k = 0; k < 1000; ++k) {
      world.step({});
      column.push_back(world.truth(0).joints[0]);
    }
    EXPECT_NEAR(frequency_of(column, kStep), frequency, 0.03 * frequency);
  }
}

TEST(ElasticArm, EncodersReadTheMotors) {
  World world(elastic_world(8));
  HardwareCommand shove{.enabled = true};
  shove.pwm[0] = 15;
  for (int k = 0; k < 10; ++k) world.step({&shove, 1});
  for (int k = 0; k < 200; ++k) world.step({});
  const auto counts = world.reading(0).encoder;
  double least = 1e9, most = -1e9;
  for (int k = 0; k < 100; ++k) {
    world.step({});
    EXPECT_EQ(world.reading(0).encoder, counts);
    least = std::min(least, world.truth(0).joints[0]);
    most = std::max(most, world.truth(0).joints[0]);
  }
  EXPECT_GT(most - least, 1e-5) << "the link swings";
}

TEST(ElasticArm, StandsStillAtItsStart) {
  World world(elastic_world(8));
  const AxisVector start = world.start_joints(0);
  const auto counts = world.reading(0).encoder;
  for (int k = 0; k < 1000; ++k) world.step({});
  EXPECT_LT((world.truth(0).joints - start).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(world.reading(0).encoder, counts);
}

TEST(ElasticArm, WithoutElasticityIsTheRigidArmBitByBit) {
  PressingArm rigid, same(elastic_world(0, 0.5));
  rigid.prepare();
  same.prepare();
  EXPECT_EQ(rigid.world.state_hash(), same.world.state_hash());
}

TEST(ElasticArm, IsRepeatable) {
  PressingArm one(elastic_world(10)), other(elastic_world(10));
  one.prepare();
  other.prepare();
  EXPECT_EQ(one.world.state_hash(), other.world.state_hash());
}

}  // namespace
}  // namespace mrroc::sim
