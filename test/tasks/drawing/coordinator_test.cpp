// The coordinator's table by value: every row, every terminal condition, every memory of MS 8.2.
#include <gtest/gtest.h>

#include <random>

#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using enum PenState;

const Motion<Coordinator>& row(int m) { return kCoordinator[static_cast<std::size_t>(m - 1)]; }

X image(PenState pen_1 = above_paper, PenState pen_2 = above_paper) {
  X x;
  x.c.recording = Recording(0.02);
  x.T.agent[0].sensor = static_cast<int>(pen_1);
  x.T.agent[1].sensor = static_cast<int>(pen_2);
  x.T.agent[0].ready = x.T.agent[1].ready = true;
  x.T.h.started = true;
  return x;
}

Recording recording(std::initializer_list<PenState> pens) {
  Recording r(0.02);
  double k = 0;
  for (const PenState pen : pens) {
    ++k;
    r = r.appended({Twist{{0.001 * k, -0.002 * k, 0.5, 0.5, 0.5, 0.5}}, pen});
  }
  return r;
}

TEST(Coordinator, RowsHaveTheNumbersOfThePaper) {
  for (int m = 1; m <= 7; ++m) EXPECT_EQ(row(m).m, m);
  EXPECT_EQ(kWaitForStart.m, 0);
}

TEST(Coordinator, WaitsForBothArmsAndTheOperator) {
  X x = image();
  EXPECT_TRUE(kWaitForStart.f_tau(x));
  x.T.h.started = false;
  EXPECT_FALSE(kWaitForStart.f_tau(x));
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    x = image();
    x.T.agent[arm].ready = false;
    EXPECT_FALSE(kWaitForStart.f_tau(x));
  }
}

TEST(Coordinator, OrdersCarryTheRowOfTheirTable) {
  struct Row {
    int m;
    TaskFrameCommand arm_1, arm_2;
  };
  const std::vector<Row> table{{1, kCompliant, kBlocked},    {2, kCompliant, kBlocked},
                               {3, kCompliant, kCompliant},  {4, kLowering, kLowering},
                               {5, kOnPaper, kOnPaper},      {6, kLiftOff, kLiftOff},
                               {7, kAbovePaper, kAbovePaper}};
  for (const Row& r : table) {
    const auto orders = row(r.m).f_cT(image());
    EXPECT_EQ(orders[0].arm.frame, r.arm_1) << r.m;
    EXPECT_EQ(orders[1].arm.frame, r.arm_2) << r.m;
    for (const Order& o : orders) {
      EXPECT_EQ(o.m, r.m);
      EXPECT_FALSE(o.finished);
      EXPECT_EQ(o.arm.mu, Interpolation::tcim_velocity);
      EXPECT_EQ(o.arm.n_s, 10);
      EXPECT_EQ(o.arm.n_Q, 9);
    }
  }
  for (const Order& o : kWaitForStart.f_cT(image())) EXPECT_EQ(o.arm.frame, kBlocked);
}

TEST(Coordinator, TeachForceActsOnlyOnThePaperAndOnlyOnArm1) {
  for (const PenState pen : kPenStates) {
    X x = image(pen, paper_surface);
    x.c.k.teach_force = 1.5;
    EXPECT_EQ(row(2).f_cT(x)[0].arm.frame.z.force, pen == paper_surface ? 1.5 : 0) << to_string(pen);
    EXPECT_EQ(row(2).f_cT(x)[1].arm.frame.z.force, 0);
    EXPECT_EQ(row(1).f_cT(x)[0].arm.frame.z.force, 0);
  }
}

TEST(Coordinator, DrawForceIsTheParameterOnBothArms) {
  X x = image();
  x.c.k.draw_force = 2.5;
  for (const Order& o : row(5).f_cT(x)) EXPECT_EQ(o.arm.frame.z.force, 2.5);
}

TEST(Coordinator, LeadingEndsWhenPen1IsOnThePaper) {  // (38)
  for (const PenState pen : kPenStates) {
    EXPECT_EQ(row(1).f_tau(image(pen)), pen == paper_surface);
    EXPECT_FALSE(row(1).f_tau(image(above_paper, pen)));
  }
}

TEST(Coordinator, RecordingAndLeadingToTheStartEndWithANewTrigger) {  // (41), (43)
  for (const int m : {2, 3}) {
    X x = image(paper_surface, paper_surface);
    x.T.h.trigger = 4;
    x.c = row(m).f_entry(x);
    EXPECT_FALSE(row(m).f_tau(x)) << m;
    x.T.h.trigger = 5;
    EXPECT_TRUE(row(m).f_tau(x)) << m;
    x.c = row(m).f_entry(x);  // the next behaviour does not take it again
    EXPECT_FALSE(row(m).f_tau(x)) << m;
  }
}

TEST(Coordinator, LoweringEndsWhenBothPensHaveSettled) {  // (45)
  for (const int settle : {0, 1, 25}) {
    X x = image(paper_surface, paper_surface);
    x.c.k.settle = settle;
    x.c.time = 1000.25;
    x.c = row(4).f_entry(x);
    EXPECT_FALSE(row(4).f_tau(x)) << "before the first iteration";
    int macrosteps = 0;
    do {
      x.c = row(4).f_cc(x);
      ++macrosteps;
    } while (!row(4).f_tau(x) && macrosteps < 100);
    EXPECT_EQ(macrosteps, settle + 1);
  }
}

TEST(Coordinator, APenThatLeavesThePaperBeginsSettlingAnew) {
  X x = image(paper_surface, paper_surface);
  x.c.k.settle = 10;
  x.c = row(4).f_entry(x);
  for (int k = 0; k < 8; ++k) x.c = row(4).f_cc(x);
  x.T.agent[1].sensor = static_cast<int>(lift_off);
  x.c = row(4).f_cc(x);
  EXPECT_FALSE(row(4).f_tau(x));
  x.T.agent[1].sensor = static_cast<int>(paper_surface);
  for (int k = 0; k < 10; ++k) {
    x.c = row(4).f_cc(x);
    EXPECT_FALSE(row(4).f_tau(x)) << k;
  }
  x.c = row(4).f_cc(x);
  EXPECT_TRUE(row(4).f_tau(x));
}

TEST(Coordinator, OnePenOnThePaperIsNotEnough) {
  for (const auto& x_0 : {image(paper_surface, above_paper), image(above_paper, paper_surface)}) {
    X x = x_0;
    x.c = row(4).f_entry(x);
    for (int k = 0; k < 200; ++k) {
      x.c = row(4).f_cc(x);
      ASSERT_FALSE(row(4).f_tau(x));
    }
  }
}

TEST(Coordinator, StrokeEndsBeforeTheFirstNodeThatIsNotOnThePaper) {  // (47), (48)
  X x = image();
  x.c.recording = recording({paper_surface, paper_surface, lift_off, above_paper, paper_surface});
  EXPECT_FALSE(row(5).f_tau(x));
  x.c = row(5).f_cc(x);
  EXPECT_EQ(x.c.p, 1);
  EXPECT_FALSE(row(5).f_tau(x));
  x.c = row(5).f_cc(x);
  EXPECT_EQ(x.c.p, 2);
  EXPECT_TRUE(row(5).f_tau(x));
  EXPECT_EQ(row(5).f_cc(x).p, 2);  // and does not go on by itself
}

TEST(Coordinator, TravelEndsBeforeTheFirstNodeOnThePaper) {  // (51), (52)
  X x = image();
  x.c.recording = recording({paper_surface, lift_off, above_paper, lowering, paper_surface});
  EXPECT_TRUE(row(7).f_tau(x));
  x.c.p = 1;
  for (int p = 2; p <= 4; ++p) {
    EXPECT_FALSE(row(7).f_tau(x));
    x.c = row(7).f_cc(x);
    EXPECT_EQ(x.c.p, p);
  }
  EXPECT_TRUE(row(7).f_tau(x));
}

TEST(Coordinator, BothEndAfterTheLastNode) {
  X x = image();
  x.c.recording = recording({paper_surface, above_paper});
  x.c.p = 2;
  EXPECT_TRUE(row(5).f_tau(x));
  EXPECT_TRUE(row(7).f_tau(x));
  for (const int m : {5, 7}) {
    const auto frame = row(m).f_cT(x)[0].arm.frame;
    EXPECT_EQ(frame.x.velocity, 0);
    EXPECT_EQ(frame.y.velocity, 0);
  }
}

TEST(Coordinator, ReproductionOrdersTheVelocityOfItsNodeAlongThePaperOnly) {  // (46)
  X x = image();
  x.c.recording = recording({paper_surface, paper_surface, above_paper});
  x.c.p = 1;
  auto frame = row(5).f_cT(x)[1].arm.frame;
  EXPECT_DOUBLE_EQ(frame.x.velocity, 0.002);
  EXPECT_DOUBLE_EQ(frame.y.velocity, -0.004);
  for (const Axis a : {Axis::z, Axis::ax, Axis::ay, Axis::az}) EXPECT_EQ(frame[a].velocity, 0);
  x.c.p = 2;
  frame = row(7).f_cT(x)[0].arm.frame;
  EXPECT_DOUBLE_EQ(frame.x.velocity, 0.003);
  EXPECT_EQ(frame.z, u());
}

TEST(Coordinator, LiftOffLastsItsMacrosteps) {  // (49), (50)
  X x = image();
  x.c.time = 77;
  x.c.k.lift_off = 50;
  x.c = row(6).f_entry(x);
  for (int k = 0; k < 50; ++k) {
    EXPECT_FALSE(row(6).f_tau(x)) << k;
    x.c = row(6).f_cc(x);
  }
  EXPECT_TRUE(row(6).f_tau(x));
}

TEST(Coordinator, PauseScalesVelocitiesAndKeepsForces) {
  X x = image();
  x.c.recording = recording({paper_surface, paper_surface});
  x.T.h.paused = true;
  double expected = 1;
  for (int k = 0; k < 15; ++k) {
    expected = std::max(0.0, expected - 0.1);
    const auto lift = row(6).f_cT(x)[0].arm.frame;
    EXPECT_NEAR(lift.z.velocity, -0.01 * expected, 1e-15);
    const auto draw = row(5).f_cT(x)[0].arm.frame;
    EXPECT_EQ(draw.z, c(1, 20, 0.005));
    EXPECT_NEAR(draw.x.velocity, 0.001 * expected, 1e-15);
    x.c.pace = row(6).f_cc(x).pace;
    EXPECT_NEAR(x.c.pace, expected, 1e-12);
  }
  x.T.h.paused = false;
  for (int k = 0; k < 15; ++k) x.c.pace = row(6).f_cc(x).pace;
  EXPECT_EQ(x.c.pace, 1);
}

TEST(Coordinator, AtPaceScalesEveryVelocityAndNothingElse) {
  TaskFrameCommand frame{
      .x = u(1), .y = g(2, 3, 4), .z = c(5, 6, 7), .ax = u(8), .ay = g(9, 1, 1), .az = u(-1)};
  const TaskFrameCommand half = at_pace(frame, 0.5);
  for (const Axis a : kAxes) {
    EXPECT_EQ(half[a].velocity, 0.5 * frame[a].velocity);
    AxisCommand rest = half[a];
    rest.velocity = frame[a].velocity;
    EXPECT_EQ(rest, frame[a]);
  }
}

AngleAxisPose random_step(std::mt19937& random) {
  std::normal_distribution<> n;
  AngleAxisPose r;
  for (int k = 0; k < 6; ++k) r[k] = 1e-3 * n(random);
  return r;
}

void give_pose(X& x, const Pose& T) {
  Eigen::Map<AngleAxisPose>(x.T.agent[0].T_0E.data()) = angle_axis_from_pose(T);
}

TEST(Coordinator, RecordedVelocitiesTelescopeToThePose) {  // (39), (40)
  std::mt19937 random(1);
  for (const bool with_pause : {false, true}) {
    X x = image(paper_surface);
    Pose T = pose_from_angle_axis((AngleAxisPose() << 0.8, 0.1, 0.3, 2.9, 0.4, -0.2).finished());
    give_pose(x, T);
    x.c = row(1).f_entry(x);
    EXPECT_TRUE(x.c.recording.empty());
    EXPECT_EQ(x.c.p, 0);
    x.c = row(1).f_cc(x);
    x.c = row(2).f_entry(x);
    const Pose T_touch = T;
    std::vector<PenState> pens;
    for (int k = 0; k < 500; ++k) {
      if (with_pause) x.T.h.paused = k > 100 && k < 300;
      const PenState pen = kPenStates[random() % 4];
      x.T.agent[0].sensor = static_cast<int>(pen);
      x.c = row(2).f_cc(x);
      pens.push_back(pen);
      T = T * pose_from_angle_axis(random_step(random));
      give_pose(x, T);
    }
    x.c = row(2).f_cc(x);
    pens.push_back(static_cast<PenState>(x.T.agent[0].sensor));
    ASSERT_EQ(x.c.recording.size(), 501U);
    Pose sum = T_touch;
    for (std::size_t n = 0; n < x.c.recording.size(); ++n) {
      const Node node = x.c.recording[n];
      EXPECT_EQ(node.pen, pens[n]);
      sum = sum * pose_from_angle_axis(node.velocity.vector() * 0.02);
    }
    EXPECT_LT((sum.p - T.p).norm(), 1e-9);
    EXPECT_LT((sum.R - T.R).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(x.c.recording.macrostep_s(), 0.02);
  }
}

TEST(Coordinator, APenThatRestsInAPauseLeavesNoNodes) {
  X x = image(paper_surface);
  give_pose(x, Pose{});
  x.c = row(2).f_entry(x);
  x.T.h.paused = true;
  for (int k = 0; k < 10; ++k) x.c = row(2).f_cc(x);
  const std::size_t nodes = x.c.recording.size();
  for (int k = 0; k < 100; ++k) x.c = row(2).f_cc(x);
  EXPECT_EQ(x.c.recording.size(), nodes);
  give_pose(x, {Matrix3::Identity(), Vector3(1e-3, 0, 0)});  // but a moving one does
  EXPECT_EQ(row(2).f_cc(x).recording.size(), nodes + 1);
}

TEST(Coordinator, FunctionsArePure) {
  X x = image(paper_surface, paper_surface);
  x.c.recording = recording({paper_surface, paper_surface, above_paper});
  give_pose(x, {Matrix3::Identity(), Vector3(1, 2, 3)});
  const Recording before = x.c.recording;
  for (const auto& motion : kCoordinator) {
    const auto a = motion.f_cc(x), b = motion.f_cc(x);
    EXPECT_EQ(a.recording, b.recording);
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(motion.f_cT(x)[0].arm.frame, motion.f_cT(x)[0].arm.frame);
    EXPECT_EQ(x.c.recording, before);
  }
}

TEST(TransparentAgent, CopiesOrderToCommandAndImagesToReport) {  // (34)-(36)
  Arm::X x;
  x.T.m = 5;
  x.T.arm.frame = kOnPaper;
  x.T.arm.n_s = 12;
  x.V.state = static_cast<int>(paper_surface);
  x.e.state = DriverState::executing;
  x.e.verdict = Verdict::executed;
  x.e.fault.code = FaultCode::joint_limit;
  x.e.T_0E = {1, 2, 3, 4, 5, 6};
  x.e.F_a.v = {6, 5, 4, 3, 2, 1};
  x.e.gripper = 0.05;
  x.e.blocked = true;
  const EffectorCommand y = kTransparent.f_ce(x);
  EXPECT_EQ(y.instruction, Instruction::set_get);
  EXPECT_TRUE(has(y.set, Part::arm));
  EXPECT_EQ(y.arm.frame, kOnPaper);
  EXPECT_EQ(y.arm.n_s, 12);
  const Report r = kTransparent.f_cT(x);
  EXPECT_TRUE(r.ready);
  EXPECT_EQ(r.m, 5);
  EXPECT_EQ(r.sensor, static_cast<int>(paper_surface));
  EXPECT_EQ(r.driver_state, DriverState::executing);
  EXPECT_EQ(r.verdict, Verdict::executed);
  EXPECT_EQ(r.fault.code, FaultCode::joint_limit);
  EXPECT_EQ(r.T_0E, x.e.T_0E);
  EXPECT_EQ(r.F_a, x.e.F_a);
  EXPECT_EQ(r.gripper, 0.05);
  EXPECT_TRUE(r.blocked);
  EXPECT_FALSE(kTransparent.f_tau(x));
  x.T.finished = true;
  EXPECT_TRUE(kTransparent.f_tau(x));
}

}  // namespace
}  // namespace mrroc::drawing
