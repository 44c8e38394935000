// The coordinator's table by value: every row and every terminal condition of MS 8.2.
#include <gtest/gtest.h>

#include "test/tasks/drawing/coordinator_image.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using enum PenState;

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

/// A row of MS tables 1-4, as printed.
void expect_row(const AxisCommand& row, Behaviour b, double F_d, double v_d, double I, double B) {
  EXPECT_EQ(row.b, b);
  EXPECT_EQ(row.force, F_d);
  EXPECT_EQ(row.velocity, v_d);
  EXPECT_EQ(row.inertia, I);
  EXPECT_EQ(row.mobility, B);
}

TEST(Coordinator, TablesAreThePapers) {
  using enum Behaviour;
  for (const Axis a : {Axis::x, Axis::y, Axis::z}) expect_row(kCompliant[a], contact, 0, 0, 20, 0.005);
  expect_row(kLowering.z, guarded, 0, 0.01, 20, 0.005);
  expect_row(kLiftOff.z, unguarded, 0, -0.01, 0, 0);
  expect_row(kOnPaper.z, contact, 1, 0, 20, 0.005);
  expect_row(kAbovePaper.z, unguarded, 0, 0, 0, 0);
  for (const Axis a : kAxes) expect_row(kBlocked[a], unguarded, 0, 0, 0, 0);
  for (const auto& table : {kLowering, kLiftOff, kOnPaper, kAbovePaper})
    for (const Axis a : {Axis::x, Axis::y, Axis::ax, Axis::ay, Axis::az})
      expect_row(table[a], unguarded, 0, 0, 0, 0);
  for (const Axis a : {Axis::ax, Axis::ay, Axis::az}) expect_row(kCompliant[a], unguarded, 0, 0, 0, 0);
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
    x.t.time = 1000.25;
    x.c = row(4).f_entry(x);
    EXPECT_FALSE(row(4).f_tau(x)) << "before the first iteration";
    int macrosteps = 0;
    do {
      pass(x, 4);
      ++macrosteps;
    } while (!row(4).f_tau(x) && macrosteps < 100);
    EXPECT_EQ(macrosteps, settle + 1);
  }
}

TEST(Coordinator, APenThatLeavesThePaperBeginsSettlingAnew) {
  X x = image(paper_surface, paper_surface);
  x.c.k.settle = 10;
  x.c = row(4).f_entry(x);
  for (int k = 0; k < 8; ++k) pass(x, 4);
  x.T.agent[1].sensor = static_cast<int>(lift_off);
  pass(x, 4);
  EXPECT_FALSE(row(4).f_tau(x));
  x.T.agent[1].sensor = static_cast<int>(paper_surface);
  for (int k = 0; k < 10; ++k) {
    pass(x, 4);
    EXPECT_FALSE(row(4).f_tau(x)) << k;
  }
  pass(x, 4);
  EXPECT_TRUE(row(4).f_tau(x));
}

TEST(Coordinator, OnePenOnThePaperIsNotEnough) {
  for (const auto& x_0 : {image(paper_surface, above_paper), image(above_paper, paper_surface)}) {
    X x = x_0;
    x.c = row(4).f_entry(x);
    for (int k = 0; k < 200; ++k) {
      pass(x, 4);
      ASSERT_FALSE(row(4).f_tau(x));
    }
  }
}

TEST(Coordinator, LoweringEndsWithoutContactAtTheTimeout) {
  for (const auto& x_0 : {image(), image(paper_surface, above_paper), image(above_paper, paper_surface)}) {
    X x = x_0;
    x.c.k.touch_timeout = 30;
    x.t.time = 500;
    x.c = row(4).f_entry(x);
    for (int k = 0; k < 30; ++k) {
      EXPECT_FALSE(row(4).f_tau(x)) << k;
      pass(x, 4);
    }
    EXPECT_TRUE(row(4).f_tau(x));
    EXPECT_TRUE(no_contact(x));
  }
}

TEST(Coordinator, TheTimeoutStandsStillDuringAPause) {
  X x = image();
  x.c.k.touch_timeout = 30;
  x.c = row(4).f_entry(x);
  x.T.h.paused = true;
  for (int k = 0; k < 100; ++k) pass(x, 4);
  EXPECT_FALSE(row(4).f_tau(x));
}

TEST(Coordinator, AStrokeEndsWhenAPenHasLeftTheLevelOfItsSheet) {
  X x = image(paper_surface, paper_surface);
  x.c.recording = recording({paper_surface, paper_surface, paper_surface});
  const auto at = [&x](double along, double height) {
    give_pose(x, {Matrix3::Identity(), {0.9 + along, 0, 0.92 + height}}, 1);
    return arm_off_its_sheet(x);
  };
  EXPECT_FALSE(at(0, 1)) << "it has met none yet";
  static_cast<void>(at(0, 0));
  x.c = row(5).f_entry(x);
  EXPECT_FALSE(at(0, 0.007));
  EXPECT_FALSE(at(0.1, 0.015)) << "the sheet is not level";
  EXPECT_FALSE(row(5).f_tau(x));
  for (const double height : {0.012, -0.012}) {
    EXPECT_EQ(at(0, height), 1U) << height;
    EXPECT_TRUE(row(5).f_tau(x));
  }
  x.c = row(5).f_entry(x);
  EXPECT_EQ(at(0, 0.012), 1U) << "the first touch counts: later ones may be none";
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
  x.t.time = 77;
  x.c.k.lift_off = 50;
  x.c = row(6).f_entry(x);
  for (int k = 0; k < 50; ++k) {
    EXPECT_FALSE(row(6).f_tau(x)) << k;
    pass(x, 6);
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
    note_pause(x);
    const auto lift = row(6).f_cT(x)[0].arm.frame;
    EXPECT_NEAR(lift.z.velocity, -0.01 * expected, 1e-15);
    const auto draw = row(5).f_cT(x)[0].arm.frame;
    EXPECT_EQ(draw.z, c(1, 20, 0.005));
    EXPECT_NEAR(draw.x.velocity, 0.001 * expected, 1e-15);
    finish(x, 6);
    EXPECT_NEAR(x.c.paces.back(), expected, 1e-12);
  }
  x.T.h.paused = false;
  for (int k = 0; k < 15; ++k) pass(x, 6);
  EXPECT_EQ(x.c.paces.back(), 1);
}

TEST(Coordinator, AtPaceScalesEveryVelocityAndNothingElse) {
  TaskFrameCommand frame{
      .x = u(1), .y = g(2, 3, 4), .z = c(5, 6, 7), .ax = u(8), .ay = g(9, 1, 1), .az = u(-1)};
  const TaskFrameCommand half = ecp::at_pace(frame, 0.5);
  for (const Axis a : kAxes) {
    EXPECT_EQ(half[a].velocity, 0.5 * frame[a].velocity);
    AxisCommand rest = half[a];
    rest.velocity = frame[a].velocity;
    EXPECT_EQ(rest, frame[a]);
  }
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

}  // namespace
}  // namespace mrroc::drawing
