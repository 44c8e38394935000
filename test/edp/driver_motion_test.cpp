// What a driver makes of motion commands.
#include <gtest/gtest.h>

#include "rig.hpp"

namespace mrroc::edp::test {
namespace {

TEST(DriverMotion, ApproachInGuardedModeSettlesAtVelocityOverMobility) {
  Rig rig;
  ASSERT_EQ(rig.synchronise().verdict, Verdict::executed);
  rig.world.stiffness[2] = 5000;
  rig.world.one_sided = true;
  rig.world.T_0E_free.p.z() += 0.005;
  const EffectorReply reply = rig.repeat(rig.velocity({u(), u(), g(0.01, 5, 0.0025), u(), u(), u()}), 200);
  EXPECT_EQ(reply.verdict, Verdict::executed);
  EXPECT_NEAR(reply.F_a[Axis::z], 4, 0.02);
  EXPECT_NEAR(rig.world.T_0E().p.z() - rig.world.T_0E_free.p.z(), 4. / 5000, 1e-5);
}

}  // namespace
}  // namespace mrroc::edp::test
