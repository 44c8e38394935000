// Homing: positions found by switches and zero marks, whatever the start; faults that name their axis.
#include <gtest/gtest.h>

#include "test/base/random_pose.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

using mrroc::test::uniform;

DriverParameters parameters() {
  DriverParameters p = Rig::parameters();
  p.synchronisation = Synchronisation::homing;
  p.homing.first_axis = 2;
  for (AxisHoming& axis : p.homing.axis) axis.coarse = 100;  // quick tests
  return p;
}

AxisVector random_joints(std::mt19937_64& random) {
  const FakeArm arm;
  AxisVector m(FakeArm::kAxes);
  for (int k = 0; k < FakeArm::kAxes; ++k)
    m[k] = uniform(random, arm.axis(k).motor.lower + 1, arm.axis(k).motor.upper - 1);
  return arm.joints_from_motors(m);
}

/// @return the reply in which homing has ended
EffectorReply home(Rig& rig) {
  EffectorReply reply = rig.macrostep(rig.command(Instruction::synchro));
  for (int k = 0; k < 20'000 && reply.state == DriverState::homing; ++k) reply = rig.silence(1);
  return reply;
}

TEST(Homing, FindsThePositionsFromAnywhereInTheLimits) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 20; ++run) {
    Rig rig(parameters(), random_joints(random));
    rig.world.limit_switches = true;
    for (auto& s : rig.world.synchro) s.place = uniform(random, -6, -0.3);
    const EffectorReply reply = home(rig);
    ASSERT_EQ(reply.state, DriverState::ready) << describe(reply.fault);
    const AxisVector truth = rig.world.motors();
    for (int k = 0; k < FakeArm::kAxes; ++k)
      ASSERT_NEAR(reply.motors[static_cast<std::size_t>(k)], truth[k], 3 * 2 * std::numbers::pi / 4000) << k;
    ASSERT_EQ(rig.macrostep(rig.velocity({u(0.01), u(), u(), u(), u(), u()})).verdict, Verdict::executed);
  }
}

TEST(Homing, GoesThroughTheAxesInTheGivenOrderOneAtATime) {
  Rig rig(parameters());
  std::vector<int> order;
  rig.after_each_step = [&] {
    const AxisVector& inc = rig.driver.set_point().motor_increment;
    int moving = 0;
    for (int k = 0; k < FakeArm::kAxes; ++k) {
      if (inc[k] == 0 || rig.driver.state() != DriverState::homing) continue;
      ++moving;
      if (order.empty() || order.back() != k) order.push_back(k);
    }
    EXPECT_LE(moving, 1);
  };
  home(rig);
  EXPECT_EQ(order, (std::vector<int>{2, 3, 4, 5, 0, 1}));
}

TEST(Homing, EndsWithoutAJoltOfTheDrives) {
  Rig rig(parameters());
  double largest = 0;
  rig.after_each_step = [&] {
    if (rig.driver.state() != DriverState::ready) return;
    for (const double pwm : rig.last.pwm) largest = std::max(largest, std::abs(pwm));
  };
  home(rig);
  rig.silence(3);
  EXPECT_LT(largest, 2);
}

struct Damage {
  FaultCode code;
  void (*apply)(FakeWorld::SynchroSwitch&);
};
const std::vector<Damage> kDamages{
    {FaultCode::synchro_switch_missing, [](FakeWorld::SynchroSwitch& s) { s.missing = true; }},
    {FaultCode::synchro_switch_stuck, [](FakeWorld::SynchroSwitch& s) { s.stuck = true; }},
    {FaultCode::encoder_index_missing, [](FakeWorld::SynchroSwitch& s) { s.index = false; }},
};

TEST(Homing, WrongOrMissingSwitchIsAFatalFaultThatNamesTheAxis) {
  for (const Damage& damage : kDamages)
    for (const bool limits : {true, false})
      for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
        Rig rig(parameters());
        rig.world.limit_switches = limits;
        damage.apply(rig.world.synchro[k]);
        const EffectorReply reply = home(rig);
        EXPECT_EQ(reply.state, DriverState::faulted);
        EXPECT_EQ(reply.fault.code, damage.code) << k << describe(reply.fault);
        EXPECT_EQ(reply.fault.axis, static_cast<int>(k));
        EXPECT_EQ(class_of(reply.fault.code), FaultClass::fatal);
        EXPECT_EQ(reply.fault.text.view(), rig.arm.axis(static_cast<int>(k)).name);
        EXPECT_FALSE(rig.last.enabled);
        EXPECT_FALSE(rig.driver.synchronised());
      }
}

TEST(Homing, AxisDoesNotGoFartherThanItsRangeWithoutLimitSwitches) {
  Rig rig(parameters());
  rig.world.synchro[3].missing = true;
  const double start = rig.world.motors()[3];
  home(rig);
  const Range& legal = rig.arm.axis(3).motor;
  EXPECT_LT(std::abs(rig.world.motors()[3] - start), legal.upper - legal.lower + 5);
}

TEST(Homing, GlitchOfOneReadingIsNoSwitch) {
  Rig rig(parameters());
  bool done = false;
  rig.after_each_step = [&] {
    rig.world.switches[2] = 0;
    if (!done && rig.driver.set_point().motor_increment[2] < -0.15)
      rig.world.switches[2] = static_cast<std::uint8_t>(AxisSwitch::synchro), done = true;
  };
  EXPECT_EQ(home(rig).state, DriverState::ready);
  EXPECT_TRUE(done);
  EXPECT_LT((rig.driver.set_point().axes.motors - rig.world.motors()).cwiseAbs().maxCoeff(), 0.02);
}

TEST(Homing, TheSwitchMustLetGoWithinTwoTurnsAndTheZeroMarkComeWithinOneAndAQuarter) {
  const double turn = 2 * std::numbers::pi;
  const DriverParameters p = parameters();
  for (const bool sticks : {true, false}) {
    Rig rig(p);
    bool pressed = false;
    rig.after_each_step = [&] {  // it works until it has been reached
      pressed |= rig.world.motors()[2] < rig.world.synchro[2].place;
      rig.world.synchro[2].stuck = sticks && pressed;
    };
    if (!sticks) rig.world.synchro[2].index = false;
    const EffectorReply reply = home(rig);
    ASSERT_EQ(reply.fault.code, sticks ? FaultCode::synchro_switch_stuck : FaultCode::encoder_index_missing);
    const double limit = (sticks ? 2 : 1.25) * turn;
    EXPECT_DOUBLE_EQ(reply.fault.limit, limit);
    EXPECT_GT(reply.fault.value, limit);
    EXPECT_LT(reply.fault.value, limit + 2 * p.homing.axis[2].fine * p.dt) << "where it was noticed";
  }
}

TEST(Homing, BeginsAtRestAlsoWhenItWasBrokenOffAtFullSpeed) {
  const FakeArm arm;
  const DriverParameters p = parameters();
  Homing homing(arm, p.homing, p.dt);
  homing.start();
  const HardwareReading reading{};
  for (int k = 0; k < 100; ++k) ASSERT_FALSE(homing.step(reading));
  ASSERT_NEAR(homing.increment()[2], -p.homing.axis[2].coarse * p.dt, 1e-12);
  homing.start();
  const double most = p.homing.axis[2].coarse / p.homing.ramp_steps * p.dt;
  double before = 0;
  for (int k = 0; k < 100; ++k) {
    ASSERT_FALSE(homing.step(reading));
    ASSERT_LE(std::abs(homing.increment()[2] - before), most * (1 + 1e-9)) << k;
    before = homing.increment()[2];
  }
  EXPECT_LT(before, 0) << "it looks for the switch again";
}

TEST(Homing, GoesBackToWhereItStoodWhenItIsTo) {
  std::mt19937_64 random(6);
  DriverParameters p = parameters();
  p.homing.returns = true;
  for (int run = 0; run < 20; ++run) {
    Rig rig(p, random_joints(random));
    rig.world.limit_switches = true;
    const AxisVector start = rig.world.motors();
    std::vector<int> order;
    AxisVector before = AxisVector::Zero(FakeArm::kAxes);
    rig.after_each_step = [&] {
      const AxisVector& now = rig.driver.set_point().motor_increment;
      if (rig.driver.state() != DriverState::homing) return;
      for (int k = 0; k < FakeArm::kAxes; ++k) {
        const AxisHoming& axis = p.homing.axis[static_cast<std::size_t>(k)];
        ASSERT_LE(std::abs(now[k]), axis.coarse * p.dt * (1 + 1e-9));
        ASSERT_LE(std::abs(now[k] - before[k]), 1.13 * axis.coarse / p.homing.ramp_steps * p.dt);
        if (now[k] != 0 && (order.empty() || order.back() != k)) order.push_back(k);
      }
      before = now;
    };
    ASSERT_EQ(home(rig).state, DriverState::ready) << describe(rig.driver.fault());
    const EffectorReply reply = rig.silence(2);  // the shafts are a step behind
    const double increment = 2 * std::numbers::pi / 4000;
    ASSERT_LT((rig.world.motors() - start).cwiseAbs().maxCoeff(), 3 * increment) << run;
    for (int k = 0; k < FakeArm::kAxes; ++k)
      ASSERT_NEAR(reply.motors[static_cast<std::size_t>(k)], start[k], 3 * increment) << k;
    EXPECT_EQ(order, (std::vector<int>{2, 3, 4, 5, 0, 1, 0, 5, 4, 3, 2})) << "the way it has come";
  }
}

TEST(Homing, AfterAMendedSwitchResetAndSynchroSucceed) {
  Rig rig(parameters());
  rig.world.synchro[5].missing = true;
  EXPECT_EQ(home(rig).state, DriverState::faulted);
  rig.world.synchro[5].missing = false;
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state, DriverState::not_synchronised);
  rig.number = 0;
  EXPECT_EQ(home(rig).state, DriverState::ready);
}

TEST(Homing, ReleasedDriverComesToRestUnsynchronised) {
  Rig rig(parameters());
  rig.macrostep(rig.command(Instruction::synchro));
  while (rig.driver.set_point().motor_increment[2] == 0) rig.silence(1);
  ASSERT_EQ(rig.driver.state(), DriverState::homing);
  EffectorCommand release;
  release.session = 7;
  release.instruction = Instruction::release;
  rig.macrostep(release);
  EXPECT_EQ(rig.driver.state(), DriverState::jogging);
  rig.silence(8);
  EXPECT_EQ(rig.driver.state(), DriverState::not_synchronised);
  EXPECT_FALSE(rig.last.enabled);
}

TEST(Homing, UnsynchronisedArmMovesByRelativeMotorPositionsOnly) {
  Rig rig(parameters());
  rig.silence(2);
  const AxisVector before = rig.world.motors();
  EXPECT_EQ(rig.macrostep(rig.jog({1, -2, 3, 0.5, -0.5, 0.25})).verdict, Verdict::executed);
  rig.silence(10);
  const AxisVector moved = rig.world.motors() - before;
  const std::array<double, 6> commanded{1, -2, 3, 0.5, -0.5, 0.25};
  for (int k = 0; k < FakeArm::kAxes; ++k)
    EXPECT_NEAR(moved[k], commanded[static_cast<std::size_t>(k)], std::abs(moved[k]) * 0.25)
        << "and its stop";
  EXPECT_EQ(rig.driver.state(), DriverState::not_synchronised);
  for (const Reference reference : {Reference::absolute, Reference::relative})
    for (const Representation r : {Representation::motors, Representation::joints, Representation::frame})
      for (const Interpolation mu :
           {Interpolation::mim, Interpolation::tcim_pose, Interpolation::tcim_velocity}) {
        if (mu == Interpolation::mim && r == Representation::motors && reference == Reference::relative)
          continue;
        EffectorCommand c = rig.jog({});
        c.arm.mu = mu;
        c.arm.reference = reference;
        c.arm.representation = r;
        if (r == Representation::frame) c.arm.pose = numbers_from_pose(r, Pose{});
        const EffectorReply reply = rig.macrostep(c);
        EXPECT_EQ(reply.verdict, Verdict::refused);
        EXPECT_EQ(reply.fault.code, FaultCode::not_synchronised);
      }
}

TEST(Homing, JogIsBoundBySpeedAndLimitSwitches) {
  Rig rig(parameters());
  rig.world.limit_switches = true;
  EXPECT_EQ(rig.macrostep(rig.jog({100}, 100)).fault.code, FaultCode::too_fast);
  rig.number = 0;  // a refused command begins no session
  EffectorReply reply;
  for (int k = 0; k < 20 && rig.driver.state() != DriverState::faulted; ++k)
    reply = rig.macrostep(rig.jog({30}, 100));
  EXPECT_EQ(reply.fault.code, FaultCode::limit_switch);
  EXPECT_EQ(reply.fault.axis, 0);
}

TEST(Homing, AnArmThatWasPushedWithItsBrakesClosedIsHomedFromWhereItIs) {
  Rig rig(parameters());
  rig.silence(2);
  for (const std::size_t k : {0, 3, 5})
    rig.world.slip[k] = 2000;  // 3 rad, twice the following error that is a fault
  rig.silence(1);
  EXPECT_EQ(home(rig).state, DriverState::ready) << describe(rig.driver.fault());
}

TEST(Homing, JogThenSynchroFindsTheSamePositions) {
  Rig rig(parameters());
  rig.macrostep(rig.jog({10, 10, 10, 5, 5, 5}));
  rig.silence(8);
  EXPECT_EQ(home(rig).state, DriverState::ready);
  EXPECT_LT((rig.driver.set_point().axes.motors - rig.world.motors()).cwiseAbs().maxCoeff(), 0.02);
}

}  // namespace
}  // namespace mrroc::edp::test
