// A driver whose arm has jaws: their motor stands behind those of the axes.
#include <gtest/gtest.h>

#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr std::size_t kJaws = FakeArm::kAxes;
constexpr double kIncrements = 100;  // of a radian

double distance(double motor) noexcept { return 0.07 - 1e-5 * motor; }
double motor(double distance) noexcept { return (0.07 - distance) / 1e-5; }

DriverParameters with_jaws() {
  DriverParameters p = Rig::parameters();
  GripperParameters g;
  g.distance = distance;
  g.motor = motor;
  g.legal = {0.05, 0.09};
  g.open_stop = -2100;
  g.increments_per_rad = kIncrements;
  g.speed = g.opening_speed = 1000;
  g.acceleration = 5000;
  g.homing_speed = 250;
  g.max_current = 0.15;
  g.stiffness = 0.03;
  g.damping = 0.001;
  g.current_gain = 100;
  g.over_current = 0.2;
  g.blocked_current = 0.1;
  g.blocked_motion = 0.5;
  g.blocked_steps = 5;
  p.gripper = g;
  p.jaws = 0.07;
  return p;
}

/// A rig whose jaws turn with their duty cycle.
class JawsRig : public testing::Test {
 protected:
  explicit JawsRig(const DriverParameters& p = with_jaws()) : rig(p) {}

  EffectorReply macrostep(const std::optional<EffectorCommand>& c = std::nullopt) {
    if (c) rig.driver.take(*c);
    EffectorReply reply{};
    do {
      HardwareReading reading = rig.world.reading();
      reading.encoder[kJaws] = static_cast<std::int32_t>(std::lround(kIncrements * turned));
      reading.current[kJaws] = current;
      last = rig.driver.step(reading);
      rig.world.apply(last);
      if (last.jaws_enabled && !held) turned += 0.02 * last.pwm[kJaws];
      if (turned <= stop) {
        turned = stop;
        current = -0.12;
      }
      if (rig.driver.reply_due()) reply = rig.driver.reply();
    } while (!rig.driver.at_boundary());
    return reply;
  }
  EffectorCommand grip(double gap) {
    EffectorCommand c = rig.velocity({});
    c.arm.gripper = gap;
    return c;
  }
  EffectorReply synchronise() { return macrostep(rig.command(Instruction::synchro)); }

  Rig rig;
  HardwareCommand last;
  double turned{};    // by the motor [rad]
  double current{};   // of it [A]
  double stop{-1e9};  // of the opening [rad]
  bool held{};
};

TEST_F(JawsRig, DistanceIsBelievedWithTheKnownPose) {
  EXPECT_EQ(macrostep().gripper, 0) << "not known";
  EXPECT_FALSE(last.jaws_enabled);
  EXPECT_EQ(last.pwm[kJaws], 0);
  synchronise();
  EXPECT_NEAR(macrostep().gripper, 0.07, 1e-4);
}

TEST_F(JawsRig, GoToTheDistanceOfACommandAndStayThereWhenItNamesNone) {
  synchronise();
  for (const double gap : {0.068, 0.072}) {
    macrostep(grip(gap));
    EffectorReply reply;
    for (int k = 0; k < 60; ++k) reply = macrostep(grip(0));
    EXPECT_EQ(reply.verdict, Verdict::executed);
    EXPECT_NEAR(reply.gripper, gap, 2e-4);
    EXPECT_FALSE(reply.blocked);
  }
}

TEST_F(JawsRig, ADistanceIsRefusedBeforeItIsKnownAndBeyondItsLimits) {
  EffectorCommand jog = rig.jog({1});
  jog.arm.gripper = 0.07;
  EXPECT_EQ(macrostep(jog).fault.code, FaultCode::not_synchronised);
  --rig.number;
  synchronise();
  for (const double wrong : {0.049, 0.091})
    EXPECT_EQ(macrostep(grip(wrong)).fault.code, FaultCode::out_of_limits);
  EXPECT_EQ(macrostep(grip(0.05)).verdict, Verdict::executed);
}

TEST_F(JawsRig, TellWhenTheyAreBlocked) {
  synchronise();
  held = true;
  current = 0.12;
  EffectorReply reply = macrostep(grip(0.06));
  reply = macrostep(grip(0));
  EXPECT_TRUE(reply.blocked);
  current = 0.05;
  EXPECT_FALSE(macrostep(grip(0)).blocked);
}

TEST_F(JawsRig, TooMuchCurrentStopsTheArmAndTheJaws) {
  synchronise();
  macrostep(grip(0.06));
  EXPECT_TRUE(last.jaws_enabled);
  current = 0.21;
  const EffectorReply reply = macrostep();
  EXPECT_EQ(reply.state, DriverState::faulted);
  EXPECT_EQ(rig.driver.fault().code, FaultCode::over_current);
  EXPECT_EQ(rig.driver.fault().axis, -1) << "no axis of the arm";
  EXPECT_FALSE(last.jaws_enabled);
  EXPECT_FALSE(last.enabled);
  EXPECT_EQ(last.pwm[kJaws], 0);
}

TEST_F(JawsRig, MoveOnWhileTheArmHoldsAndItsBrakesAreClosed) {
  synchronise();
  macrostep(grip(0.06));
  EffectorReply reply;
  for (int k = 0; k < 200; ++k) reply = macrostep();
  EXPECT_EQ(reply.state, DriverState::holding);
  EXPECT_TRUE(last.jaws_enabled);
  EXPECT_NEAR(reply.gripper, 0.06, 2e-4);
}

TEST_F(JawsRig, TheirMalfunctionDoesNotHideTheOneBefore) {
  synchronise();
  Fault stop_fault;
  stop_fault.code = FaultCode::emergency_stop;
  rig.driver.trip(stop_fault);
  current = 0.3;
  EXPECT_EQ(macrostep().fault.code, FaultCode::emergency_stop);
  EXPECT_EQ(macrostep().fault.code, FaultCode::emergency_stop);
}

DriverParameters with_jaws_of_an_arm_that_is_homed(bool known) {
  DriverParameters p = with_jaws();
  p.synchronisation = Synchronisation::homing;
  p.homing.standstill_steps = 5;
  for (AxisHoming& axis : p.homing.axis) axis.coarse = 100;  // quick tests
  p.jaws_known = known;
  p.jaws = 0.065;
  return p;
}

struct HomedJaws : JawsRig {
  explicit HomedJaws(bool known = false) : JawsRig(with_jaws_of_an_arm_that_is_homed(known)) {}
  /// @return the reply in which homing has ended
  EffectorReply home() {
    EffectorReply reply = macrostep(rig.command(Instruction::synchro));
    for (int k = 0; k < 20'000 && reply.state == DriverState::homing; ++k) {
      if (last.jaws_enabled) {
        ++opening;
        EXPECT_TRUE(rig.driver.set_point().motor_increment.isZero(0)) << "the axes are done";
      }
      reply = macrostep();
    }
    return reply;
  }
  int opening{};  // macrosteps in which the jaws were driven
};
struct HomedKnownJaws : HomedJaws {
  HomedKnownJaws() : HomedJaws(true) {}
};

TEST_F(HomedJaws, OpenUntilTheirStopWhenTheAxesAreDone) {
  stop = -50;
  const EffectorReply reply = home();
  EXPECT_EQ(reply.state, DriverState::ready) << describe(reply.fault);
  EXPECT_GT(opening, 5);
  EXPECT_NEAR(macrostep().gripper, distance(-2100), 1e-4);
  EXPECT_NEAR(turned, stop, 3) << "they stay there";
}

TEST_F(HomedJaws, ThatFindNoStopAreAMalfunctionOfTheDriver) {
  const EffectorReply reply = home();
  EXPECT_EQ(reply.state, DriverState::faulted);
  EXPECT_EQ(rig.driver.fault().code, FaultCode::synchro_switch_missing);
  EXPECT_FALSE(last.jaws_enabled);
  EXPECT_EQ(last.pwm[kJaws], 0);
}

TEST_F(HomedKnownJaws, DoNotOpen) {
  EXPECT_EQ(home().state, DriverState::ready);
  EXPECT_NEAR(macrostep().gripper, 0.065, 1e-6);
  EXPECT_NEAR(turned, 0, 1e-6);
  EXPECT_TRUE(last.jaws_enabled) << "they hold what they have";
}

TEST(JawsOfAnArm, WhoseParametersMakeNoSenseAreRefused) {
  DriverParameters p = with_jaws();
  p.gripper->speed = 0;
  EXPECT_THROW(Rig rig(p), FaultError);
}

}  // namespace
}  // namespace mrroc::edp::test
