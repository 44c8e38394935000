// A blocked arm meets the limit of a motor's current, and the task goes on as its rows say: driver, drives of a plant
// without simulator, and an agent's table, in lock-step.
#include <gtest/gtest.h>

#include "ecp/generators/rows.hpp"
#include "edp/driver.hpp"
#include "edp/loopback_hardware.hpp"
#include "robots/irb6/arm.hpp"

namespace mrroc::edp {
namespace {

constexpr int kColumn = 0;
constexpr double kTurn = 0.16;  // of its motor in a macrostep [rad]: 50 mm/s of the tool

/// An arm of the loop-back plant whose column turns between stops, and its driver.
struct BlockedArm {
  explicit BlockedArm(ServoChoice servo)
      : arm(irb6::kPostument), plant(arm, arm.motors_from_joints(joints()), kDt) {
    const double here = plant.motors()[kColumn];
    plant.set_stops(kColumn, {here - kFree, here + kFree});
    DriverParameters p;
    p.dt = kDt;
    p.T_WE = arm.tool_in_wrist();
    p.force.T_WS = arm.sensor_in_wrist();
    p.synchro_joints = joints();
    p.servo = servo;
    driver.emplace(arm, p);
  }
  static AxisVector joints() { return (AxisVector(6) << 0, -1.57, 0, 1.5, 1.57, 0).finished(); }
  /// One macrostep. @return its reply
  EffectorReply macrostep(EffectorCommand c) {
    if (c.instruction != Instruction::keep) {
      c.session = 1;
      c.number = ++number;
      driver->take(c);
    }
    EffectorReply reply{};
    do {
      const HardwareCommand out = driver->step(plant.reading());
      if (driver->reply_due()) reply = driver->reply();
      plant.step(&out);
      most_current = std::max(most_current, std::abs(plant.reading().current[kColumn]));
    } while (!driver->at_boundary());
    return reply;
  }

  static constexpr double kDt = 0.002;
  static constexpr double kFree = 3;  // of the column's motor, to either side [rad]
  irb6::Arm arm;
  LoopbackPlant plant;
  std::optional<Driver> driver;
  std::int64_t number{};
  double most_current{};  // of the column [A]
};

struct Memory {
  int attempts{};
};
struct Agent : ArmAgent<Memory> {};
using X = Agent::X;

/// A command that is decided in a macrostep is executed in the next one, and answered in the one after (MG 13).
struct BlockedPort {
  BlockedArm arm;
  EffectorCommand decided{}, sent{};
  EffectorReply reply{};
  std::optional<Fault> ended{};  // what a coordinator would end the task with
  std::vector<int> behaviours{};
  int left{300};  // macrosteps

  explicit BlockedPort(ServoChoice servo = {1, 0}) : arm(servo) {
    reply = arm.macrostep({.instruction = Instruction::synchro});
  }
  void dispatch(const Motion<Agent>& motion, const Agent::Y& y) {
    if (behaviours.empty() || behaviours.back() != motion.m) behaviours.push_back(motion.m);
    sent = decided;
    decided = y.e;
    if (y.T.verdict != Verdict::none && y.T.fault && !ended) ended = y.T.fault;
  }
  Outcome wait() {
    if (ended) return Outcome::faulted;
    if (--left < 0) return Outcome::aborted;
    reply = arm.macrostep(sent);
    return Outcome::terminated;
  }
  void read(X& x) const {
    x.e = reply;
    ++x.i;
  }
};

Memory count(const X& x) { return {x.c.attempts + 1}; }
/// @param turn  of the column's motor in a macrostep [rad]
EffectorCommand turn_column(double turn) {
  ArmCommand a;
  a.mu = Interpolation::mim;
  a.representation = Representation::motors;
  a.reference = Reference::relative;
  a.pose[kColumn] = turn;
  return ecp::move_arm(a);
}
EffectorCommand push(const X&) { return turn_column(kTurn); }
EffectorCommand back(const X&) { return turn_column(-kTurn); }
bool later(const X& x) { return ecp::age(x) >= 150; }
bool enough(const X& x) { return later(x) || x.c.attempts > 3; }
bool soon(const X& x) { return ecp::age(x) >= 20; }

Motion<Agent> pushing(Response on_failed) {
  Motion<Agent> motion =
      ecp::row<Agent>(1, "push", push, enough, {}, {.on_refused = on_failed, .on_failed = on_failed});
  motion.f_entry = count;
  return motion;
}
const Motion<Agent> kBack = ecp::row<Agent>(2, "draw back", back, soon);

TEST(BlockedArm, ByDefaultTheTaskEndsWithTheFaultThatNamesTheAxis) {
  BlockedPort port;
  X x;
  port.read(x);
  EXPECT_EQ(move(pushing(Response::end), x, port), Outcome::faulted);
  ASSERT_TRUE(port.ended);
  EXPECT_EQ(port.ended->code, FaultCode::excessive_torque);
  EXPECT_EQ(port.ended->axis, kColumn);
}

TEST(BlockedArm, TheDriveLimitsTheCurrentThatARegulatorAsksForWhichDoesNotKnowIt) {
  BlockedPort port(ServoChoice{0, 0});
  X x;
  port.read(x);
  EXPECT_EQ(move(pushing(Response::end), x, port), Outcome::faulted);
  ASSERT_TRUE(port.ended);
  EXPECT_EQ(port.ended->code, FaultCode::excessive_torque) << "and not over_current";
  EXPECT_NEAR(port.arm.most_current, port.arm.arm.axis(kColumn).servo.drive.current_limit, 1e-9);
}

TEST(BlockedArm, TheNextBehaviourFollowsAndDrawsBack) {
  BlockedPort port;
  X x;
  port.read(x);
  ASSERT_EQ(move(pushing(Response::next_behaviour), x, port), Outcome::terminated);
  EXPECT_LT(ecp::age(x), 150);
  EXPECT_FALSE(moves(x.e));
  const double at_the_stop = port.arm.plant.motors()[kColumn];
  ASSERT_EQ(move(kBack, x, port), Outcome::terminated);
  EXPECT_FALSE(port.ended);
  EXPECT_GT(std::abs(port.arm.plant.motors()[kColumn] - at_the_stop), 1) << "[rad]";
  EXPECT_EQ(port.behaviours, (std::vector{1, 2}));
}

TEST(BlockedArm, ARepeatedBehaviourPushesAnewUntilItsOwnConditionEndsIt) {
  BlockedPort port;
  X x;
  port.read(x);
  ASSERT_EQ(move(pushing(Response::repeat), x, port), Outcome::terminated);
  EXPECT_EQ(x.c.attempts, 4);
  EXPECT_FALSE(port.ended);
}

TEST(BlockedArm, ABehaviourThatGoesOnIsNotEnded) {
  BlockedPort port;
  X x;
  port.read(x);
  ASSERT_EQ(move(pushing(Response::go_on), x, port), Outcome::terminated);
  EXPECT_EQ(ecp::age(x), 150);
  EXPECT_FALSE(port.ended);
}

}  // namespace
}  // namespace mrroc::edp
