// A driver whose contact oscillates: it watches the axes that follow a force, and no others.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "edp/control_law.hpp"
#include "edp/deceleration.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

/// A rig whose sensor says that the force along z swings, at 10 Hz, by 10 N.
struct Swinging : Rig {
  /// @param softest  share of its mobility that an axis keeps; 1: nothing comes before the fault
  static DriverParameters never_softer_than(double softest) {
    DriverParameters p = parameters();
    p.oscillation.softest = softest;
    return p;
  }
  explicit Swinging(double softest = 1) : Rig(never_softer_than(softest)) {
    synchronise();
    after_each_step = [this] {
      world.sensor_offset[Axis::z] = 5 * std::sin(2 * std::numbers::pi * ++k / 50.);
    };
  }
  int k{};
};

/// Contact along z that hardly moves.
TaskFrameCommand stiff() { return {u(), u(), c(0, 1000, 1e-4), u(), u(), u()}; }

TEST(DriverContact, OneThatSwingsOnAndOnFailsAndTheArmComesToRest) {
  Swinging rig;
  EffectorReply reply;
  int macrosteps = 0;
  for (; macrosteps < 100 && reply.fault.code == FaultCode::none; ++macrosteps)
    reply = rig.macrostep(rig.velocity(stiff()));
  EXPECT_GT(macrosteps, 20) << "four periods at least";
  EXPECT_EQ(reply.fault.code, FaultCode::contact_unstable);
  EXPECT_EQ(reply.fault.axis, static_cast<int>(Axis::z));
  EXPECT_EQ(class_of(reply.fault.code), FaultClass::non_fatal);
  EXPECT_EQ(rig.silence(10).state, DriverState::holding);
  EXPECT_TRUE(rig.driver.set_point().motor_increment.isZero(0));
}

TEST(DriverContact, OneThatSwingsHoweverSoftTheAxisHasBecomeFailsToo) {
  const auto macrosteps_until_fault = [](double softest) {
    Swinging rig(softest);
    EffectorReply reply;
    int macrosteps = 0;
    for (; macrosteps < 500 && reply.fault.code == FaultCode::none; ++macrosteps)
      reply = rig.macrostep(rig.velocity(stiff()));
    EXPECT_EQ(reply.fault.code, FaultCode::contact_unstable);
    return macrosteps;
  };
  EXPECT_GT(macrosteps_until_fault(OscillationParameters{}.softest), 2 * macrosteps_until_fault(1));
}

// The way along x leads to a pose, as that of a motion that brakes before its goal; the force does not let it.
TEST(DriverContact, OneThatSwingsIsLeftByAWholeStopWhereverTheMotionWasToEnd) {
  Swinging rig;
  const std::function<void()> swing = rig.after_each_step;
  std::vector<double> x;  // two places before the stop, then those in it
  rig.after_each_step = [&] {
    swing();
    if (rig.driver.state() == DriverState::executing && x.size() == 2) x.erase(x.begin());
    if (rig.driver.state() != DriverState::holding) x.push_back(rig.driver.set_point().T_0E.p.x());
  };
  ArmCommand a;
  a.mu = Interpolation::tcim_pose;
  a.frame = stiff();
  a.reference = Reference::relative;
  a.representation = Representation::xyz_angle_axis;
  a.pose = {0.0004};  // 0.02 m/s
  EffectorReply reply;
  for (int k = 0; k < 100 && reply.fault.code == FaultCode::none; ++k) reply = rig.macrostep(rig.set_arm(a));
  ASSERT_EQ(reply.fault.code, FaultCode::contact_unstable);
  rig.silence(10);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  const double speed = x[1] - x[0];
  EXPECT_NEAR(speed, 0.02 * 0.002, 1e-9);
  const int n = Rig::parameters().stop_steps;
  ASSERT_GE(static_cast<int>(x.size()), n);
  for (int k = 1; k < n; ++k) {
    const auto step = static_cast<std::size_t>(k) + 1;
    ASSERT_NEAR(x[step] - x[step - 1], speed * remaining_speed(k, n), 1e-9) << "step " << k << " of the stop";
  }
  EXPECT_NEAR(rig.driver.set_point().T_0E.p.x(), x[1] + speed * stopping_way(n), 1e-8);
}

TEST(DriverContact, AnAxisThatFollowsNoForceMaySwing) {
  Swinging rig;
  for (int k = 0; k < 100; ++k)
    ASSERT_EQ(rig.macrostep(rig.velocity({c(0, 1000, 1e-4), u(), u(), u(), u(), u()})).verdict,
              Verdict::executed);
}

TEST(DriverContact, AMotionOfTheMotorsFollowsNoForceWhateverItsTableSays) {
  Swinging rig;
  for (int k = 0; k < 100; ++k) {
    EffectorCommand jog = rig.jog({0, k % 2 ? 0.1 : -0.1}, 10);
    jog.arm.frame = stiff();
    ASSERT_EQ(rig.macrostep(jog).verdict, Verdict::executed) << k;
  }
}

TEST(DriverContact, AnArmThatStandsMaySwing) {
  Swinging rig;
  rig.macrostep(rig.velocity(stiff()));
  for (int k = 0; k < 100; ++k) ASSERT_EQ(rig.silence(1).fault.code, FaultCode::none);
}

}  // namespace
}  // namespace mrroc::edp::test
