#include "tasks/move/agent.hpp"

#include <gtest/gtest.h>

#include "test/tasks/move/straight_arm.hpp"

namespace mrroc::any_motion {
namespace {

Arm::X at(std::int64_t age, std::size_t motion = 0) {
  static const auto plan = std::make_shared<const ArmPlan>(plan_of_text(R"([arm1]
start = [0.1, 0, 0, 0, 0, 0]
order = ["a", "b"]
[arm1.a]
positions = [0.2, 0, 0, 0, 0, 0]
[arm1.b]
space = "xyz_angle_axis"
interpolation = "tcim"
positions = [0, 0, 0, 0, 0, 0.1]
)")
                                                               .arms[0]);
  Arm::X x;
  x.c.plan = plan;
  x.c.motion = motion;
  x.i = 100 + age;
  x.i_0 = 100;
  return x;
}

TEST(MoveAgent, GoesToTheStartFromWhereTheArmIs) {
  Arm::X x = at(0);
  x.e.joints[1] = 0.3;
  x.c = row(Row::start).f_entry(x);
  EXPECT_EQ(x.c.path.set_position(0)[1], 0.3);
  EXPECT_EQ(x.c.path.set_position(x.c.path.macrosteps())[0], 0.1);
  EXPECT_EQ(row(Row::start).f_ce(x).arm.representation, Representation::joints);
  EXPECT_FALSE(row(Row::start).f_tau(x));
  x.i = x.i_0 + x.c.path.macrosteps();
  EXPECT_TRUE(row(Row::start).f_tau(x));
}

TEST(MoveAgent, GoesToTheStartAsQuicklyAsTipAndMotorsMay) {
  const auto macrosteps = [](const std::shared_ptr<const Body>& body, int joint) {
    Arm::X x = at(0);
    x.c.body = body;
    x.e.joints[static_cast<std::size_t>(joint)] = 0.9;
    return row(Row::start).f_entry(x).path.macrosteps();
  };
  const auto arm = std::make_shared<const StraightArm>();
  EXPECT_LT(macrosteps(arm, 5), macrosteps(arm, 1)) << "0.6 rad/s is not too fast, 0.6 m/s is";
  EXPECT_LT(macrosteps(arm, 1), macrosteps({}, 1)) << "without kinematics the way is a slow one";
}

TEST(MoveAgent, CommandsTheSetPointsOfItsMotion) {
  const Arm::X first = at(3), second = at(5, 1);
  EXPECT_EQ(row(Row::move).f_ce(first).arm.pose, first.c.plan->motions[0].command(3).pose);
  const EffectorCommand command = row(Row::move).f_ce(second);
  EXPECT_EQ(command.arm.mu, Interpolation::tcim_pose);
  EXPECT_EQ(command.arm.pose, second.c.plan->motions[1].command(5).pose);
  const auto n = first.c.plan->motions[0].path.macrosteps();
  EXPECT_FALSE(row(Row::move).f_tau(at(n - 1)));
  EXPECT_TRUE(row(Row::move).f_tau(at(n)));
}

TEST(MoveAgent, RestsUntilTheArmStandsOrWillNot) {
  Arm::X x = at(3);
  EXPECT_FALSE(row(Row::rest).f_tau(x));
  x.e.at_rest = true;
  EXPECT_TRUE(row(Row::rest).f_tau(x));
  EXPECT_FALSE(row(Row::rest).f_tau([&] {
    Arm::X early = x;
    early.i = early.i_0 + 2;
    return early;
  }()))
      << "that is said of the time before";
  EXPECT_TRUE(row(Row::rest).f_tau(at(250)));
}

TEST(MoveAgent, WaitsUntilAllArmsAreReadyForItsMotion) {
  Arm::X x = at(0, 1);
  EXPECT_EQ(row(Row::wait).f_cT(x).event, 2);
  EXPECT_EQ(row(Row::rest).f_cT(x).event, 0);
  for (const int ready : {0, 1}) {
    x.T.variant = ready;
    EXPECT_FALSE(row(Row::wait).f_tau(x)) << ready;
  }
  x.T.variant = 2;
  EXPECT_TRUE(row(Row::wait).f_tau(x));
}

TEST(MoveAgent, TheCoordinatorTellsForWhichMotionAllAreReady) {
  std::array<Report, 2> reports;
  std::array<Order, 2> orders;
  const auto told = [&](int a, int b) {
    reports[0].event = a;
    reports[1].event = b;
    coordinate(reports, orders);
    EXPECT_EQ(orders[0].variant, orders[1].variant);
    return orders[0].variant;
  };
  EXPECT_EQ(told(2, 0), 0);
  EXPECT_EQ(told(2, 1), 1);
  EXPECT_EQ(told(2, 2), 2);
  EXPECT_EQ(told(3, kWorkDone), 3) << "nobody waits for an arm that is done";
}

}  // namespace
}  // namespace mrroc::any_motion
