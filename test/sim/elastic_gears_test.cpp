#include "sim/elastic_gears.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
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

/// @return power of a signal at a frequency [Hz], in a window that keeps others out
double power_at(double frequency, const std::vector<double>& x, double dt) {
  const auto n = static_cast<double>(x.size());
  double mean = 0;
  for (const double each : x) mean += each / n;
  std::complex<double> sum;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double t = static_cast<double>(k);
    sum += (x[k] - mean) * (1 - std::cos(2 * pi * t / n)) * std::polar(1., -2 * pi * frequency * t * dt);
  }
  return std::norm(sum);
}

WorldParameters elastic_world(double frequency, double damping = 0.03) {
  WorldParameters w = PressingArm::world_of_one();
  w.arms[0].elasticity = {frequency, damping};
  return w;
}

/// @throws FaultError  the integration does not follow
void elastic_arms(double frequency, double damping, int substeps = 2) {
  WorldParameters w = rig::irb6_cell();
  for (ArmParameters& arm : w.arms) arm.elasticity = {frequency, damping};
  w.substeps = substeps;
  const World world(w, 1);
}

TEST(ElasticGears, LinkGivesWayByTorqueOverStiffness) {
  OneLink link({10, 0.2});
  constexpr double kPush = 25;  // [N m]: what swings past it is less than the brake holds
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
}

TEST(ElasticGears, FasterOrMoreDampedThanTheIntegrationFollowsAreRefused) {
  EXPECT_THROW(OneLink({300, 0.03}), FaultError);
  EXPECT_THROW(elastic_arms(15, 0.5), FaultError);
  EXPECT_THROW(elastic_arms(30, 0.3), FaultError);
  EXPECT_THROW(elastic_arms(40, 0.2), FaultError);
  try {
    elastic_arms(15, 0.5);
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    EXPECT_NE(e.remedy().find("sim.substeps"), std::string_view::npos) << e.remedy();
  }
  EXPECT_NO_THROW(elastic_arms(15, 0.5, 8));
}

TEST(ElasticGears, OfTheUsualDampingAreTakenInTheWholeLegalRange) {
  for (const double frequency : {5., 15., 30., 40.})
    EXPECT_NO_THROW(elastic_arms(frequency, 0.03)) << frequency;
}

TEST(ElasticArm, LowestModeHasTheFrequencyGiven) {
  for (const double frequency : {5., 8., 15., 40.}) {
    World world(elastic_world(frequency, 0.01));
    const auto joints = static_cast<std::size_t>(world.start_joints(0).size());
    HardwareCommand shove{.enabled = true};
    std::fill_n(shove.pwm.begin(), joints, 15.);
    for (int k = 0; k < 10; ++k) world.step({&shove, 1});
    for (int k = 0; k < 200; ++k) world.step({});  // brakes close: rotors are held
    std::vector<std::vector<double>> swings(joints);
    for (int k = 0; k < 3000; ++k) {
      world.step({});
      for (std::size_t i = 0; i < joints; ++i)
        swings[i].push_back(world.truth(0).joints[static_cast<int>(i)]);
    }
    double strongest = 0, most = 0;
    for (double f = 0.5 * frequency; f < 1.08 * frequency; f += 0.01 * frequency) {
      double power = 0;
      for (const auto& x : swings) power += power_at(f, x, kStep);
      if (power > most) most = power, strongest = f;
    }
    EXPECT_NEAR(strongest, frequency, 0.03 * frequency);
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
