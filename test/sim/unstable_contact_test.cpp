// Contact that is unstable under law (28), with the real driver in the simulator: the arm comes to a hold by
// itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "test/sim/pressing_arm.hpp"

namespace mrroc::sim {
namespace {

struct Outcome {
  Fault fault;
  DriverState state{};
  double peak_before{};    // of the true force [N]
  double peak_after{};     // from the fault on [N]
  double resting_speed{};  // of the tip, 100 steps after the fault and later [m/s]
  bool hold_can_go_on{};
};

Outcome press(double stiffness, const AxisCommand& law, int macrosteps, bool observed = true) {
  WorldParameters w = PressingArm::world_of_one();
  w.arms[0].paper.stiffness = stiffness;
  w.arms[0].start_height = 0.005;
  edp::DriverParameters p = PressingArm::driver_parameters();
  p.servo = edp::ServoChoice{0, 0};  // with which these contacts are known to be unstable
  p.oscillation.softest = 1;
  if (!observed) p.oscillation.force = std::numeric_limits<double>::infinity();
  PressingArm arm(w, p);
  arm.prepare();
  Outcome o;
  std::int64_t told = -1;
  arm.after_each_step = [&] {
    if (told < 0 && arm.driver->fault()) told = arm.world.steps();
    double& peak = told < 0 ? o.peak_before : o.peak_after;
    peak = std::max(peak, arm.force());
    if (told >= 0 && arm.world.steps() > told + 100)
      o.resting_speed = std::max(o.resting_speed, arm.world.truth(0).tip_velocity.norm());
  };
  for (int k = 0; k < macrosteps && !o.fault; ++k) {
    const EffectorReply reply = arm.move({u(), u(), law, u(), u(), u()});
    if (reply.verdict != Verdict::executed) o.fault = reply.fault;
  }
  for (int k = 0; k < 30; ++k) arm.rest();
  o.state = arm.driver->state();
  arm.after_each_step = nullptr;
  o.hold_can_go_on = arm.move({u(), u(), u(-0.005), u(), u(), u()}).verdict == Verdict::executed;
  return o;
}

struct Case {
  double stiffness;
  AxisCommand law;
};

class UnstableContact : public testing::TestWithParam<Case> {};

TEST_P(UnstableContact, EndsInAHoldThatTellsWhy) {
  const Outcome o = press(GetParam().stiffness, GetParam().law, 400);
  EXPECT_EQ(o.fault.code, FaultCode::contact_unstable);
  EXPECT_EQ(class_of(o.fault.code), FaultClass::non_fatal);
  EXPECT_EQ(o.fault.axis, 2);
  EXPECT_EQ(o.state, DriverState::holding);
  EXPECT_LT(o.resting_speed, 0.5e-3);
  EXPECT_LE(o.peak_after, o.peak_before) << "the first touch is not exceeded: " << what_happened(o.fault);
  EXPECT_LT(o.peak_before, 40);
  EXPECT_TRUE(o.hold_can_go_on);
}

INSTANTIATE_TEST_SUITE_P(Laws, UnstableContact,
                         testing::Values(Case{1e5, g(0.04, 5, 0.02)}, Case{1e5, g(0.03, 5, 0.02)},
                                         Case{3e5, g(0.02, 5, 0.01)}, Case{1e6, g(0.01, 5, 0.005)},
                                         Case{1e6, g(0.005, 5, 0.01)}));

TEST(Contact, ThatIsStableIsNotDisturbed) {
  for (const Case& c :
       {Case{2e3, g(0.01, 20, 0.005)}, Case{1e4, g(0.01, 20, 0.005)}, Case{3e4, g(0.01, 20, 0.005)},
        Case{1e4, g(0.01, 5, 0.0025)}, Case{1e5, g(0.01, 5, 0.0025)}, Case{1e4, g(0.04, 5, 0.02)}}) {
    const Outcome o = press(c.stiffness, c.law, 300);
    EXPECT_FALSE(o.fault) << what_happened(o.fault);
  }
}

// MG fig. 16: oscillations after B, which are those of gears that give way.
TEST(Contact, OfGearsThatGiveWaySettlesWhenTheDriverMaySoftenItAndIsUnstableElse) {
  for (const double softest : {1. / 64, 1.})
    for (const double frequency : {8., 15.}) {
      WorldParameters w = PressingArm::world_of_one();
      w.arms[0].elasticity = {frequency, 0.03};
      w.arms[0].paper.stiffness = 1e5;
      w.arms[0].start_height = 0.005;
      edp::DriverParameters p = PressingArm::driver_parameters();
      p.oscillation.softest = softest;
      PressingArm arm(w, p);
      arm.prepare();
      Fault fault;
      for (int k = 0; k < 250 && !fault; ++k) {
        const EffectorReply reply = arm.move({u(), u(), g(0.01, 5, 0.0025), u(), u(), u()});
        if (reply.verdict != Verdict::executed) fault = reply.fault;
      }
      if (softest == 1) {
        EXPECT_EQ(fault.code, FaultCode::contact_unstable) << frequency << " Hz";
        continue;
      }
      EXPECT_FALSE(fault) << frequency << " Hz: " << what_happened(fault);
      EXPECT_NEAR(arm.force(), 4, 0.3) << frequency << " Hz";
    }
}

}  // namespace
}  // namespace mrroc::sim
