#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/statistics.hpp"
#include "robots/irb6/parameters.hpp"
#include "robots/irb6/robot_type.hpp"
#include "test/sim/one_axis.hpp"

namespace mrroc::sim {
namespace {

struct Case {
  int algorithm_no;
  int axis;      // of the postument arm
  double lever;  // from the axis to the pen while drawing [m]
  double gear;   // there [rad/rad]
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name(irb6::kPostument.axes[static_cast<std::size_t>(info.param.axis)].properties.name);
  name += info.param.algorithm_no == 0 ? "_incremental" : "_compensating";
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

// The axis with the inertia for which its regulator was designed.
OneAxis one_axis(const Case& c) {
  const auto k = static_cast<std::size_t>(c.axis);
  OneAxis a{irb6::kPostument.axes[k].properties, arm_parameters(irb6::postument()).motors[k], 0,
            c.lever / c.gear, 0.05};
  const double time_constant =
      kStep / std::log(a.axis.servo.incremental[0].b0 / a.axis.servo.incremental[0].b1);
  a.inertia = time_constant / mechanical_time_constant(a.motor, 1);
  return a;
}

// Amplitude of the tip over that of a sinusoidal set position of 1 mm.
double gain(const OneAxis& axis, int algorithm_no, double frequency) {
  constexpr double kAmplitude = 1e-3;
  constexpr int kSteps = 4000;
  const double w = 2 * std::numbers::pi * frequency * kStep;
  OneAxisRig rig(axis, algorithm_no);
  double set = 0, sine = 0, cosine = 0;
  for (int k = 1; k <= kSteps; ++k) {
    const double next = kAmplitude * std::sin(w * k);
    rig.step(next - set);
    set = next;
    if (k <= kSteps / 2) continue;
    sine += rig.tip() * std::sin(w * k);
    cosine += rig.tip() * std::cos(w * k);
  }
  return std::hypot(sine, cosine) / (kSteps / 4.0) / kAmplitude;
}

class OneAxisContact : public testing::TestWithParam<Case> {};

TEST_P(OneAxisContact, MotorsLetTheRegulatorHaveTheBandwidthItWasDesignedFor) {
  const OneAxis axis = one_axis(GetParam());
  EXPECT_NEAR(gain(axis, GetParam().algorithm_no, 2), 1, 0.15);
  EXPECT_GT(gain(axis, GetParam().algorithm_no, 15), std::numbers::sqrt2 / 2);
  EXPECT_LT(gain(axis, GetParam().algorithm_no, 40), std::numbers::sqrt2 / 2);
}

TEST_P(OneAxisContact, GuardedApproachSettlesAtVelocityOverB) {
  OneAxisRig rig(one_axis(GetParam()), GetParam().algorithm_no);
  rig.wall = 0.002;
  double peak = 0;
  for (int k = 0; k < 1500; ++k) {
    rig.step(g(0.01, 20, 0.005));
    peak = std::max(peak, rig.force());
  }
  Statistics force;
  for (int k = 0; k < 1000; ++k) {
    rig.step(g(0.01, 20, 0.005));
    force.add(rig.force());
  }
  EXPECT_NEAR(force.mean(), 2, 0.03);
  EXPECT_LT(peak, 6);
}

TEST_P(OneAxisContact, ForceOnPaperIsQuietDespiteFriction) {
  OneAxisRig rig(one_axis(GetParam()), GetParam().algorithm_no);
  rig.wall = 0.0005;
  for (int k = 0; k < 1000; ++k) rig.step(g(0.01, 20, 0.005));
  for (int k = 0; k < 1000; ++k) rig.step(c(1, 20, 0.005));
  Statistics force;
  for (int k = 0; k < 5000; ++k) {
    rig.step(c(1, 20, 0.005));
    force.add(rig.force());
  }
  EXPECT_NEAR(force.mean(), 1, 0.01);
  EXPECT_LT(force.deviation(), 0.06);
}

INSTANTIATE_TEST_SUITE_P(AxesThatPressOrLead, OneAxisContact,
                         testing::Values(Case{0, 0, 0.90, 158}, Case{0, 1, 0.455, 168}, Case{0, 2, 0.67, 172},
                                         Case{0, 3, 0.31, 128}, Case{1, 0, 0.90, 158}, Case{1, 1, 0.455, 168},
                                         Case{1, 2, 0.67, 172}, Case{1, 3, 0.31, 128}),
                         name_of);

}  // namespace
}  // namespace mrroc::sim
