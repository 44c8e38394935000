// The transparent agents by value.
#include <gtest/gtest.h>

#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

using enum PenState;

TEST(TransparentAgent, CopiesOrderToCommandAndImagesToReport) {  // (34)-(36)
  Arm::X x;
  x.T.m = 5;
  x.T.arm.frame = kOnPaper;
  x.T.arm.n_s = 12;
  x.V.state = static_cast<int>(paper_surface);
  x.e.state = DriverState::executing;
  x.e.verdict = Verdict::executed;
  x.e.fault.code = FaultCode::joint_limit;
  x.e.position_known = true;
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
  EXPECT_TRUE(r.position_known);
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
