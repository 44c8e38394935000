// Commands that must not be executed: nothing of the driver's state may change by them.
#include <gtest/gtest.h>

#include <cstring>

#include "test/edp/guard_count.hpp"
#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {
namespace {

#ifdef MRROC_SANITIZED
constexpr int kCommands = 3'000;
#else
constexpr int kCommands = 30'000;
#endif

TEST(DriverInvalid, RefusalGoesOnDoingWhatItDid) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 200; ++run) {
    Rig rig;
    rig.synchronise();
    rig.world.stiffness.head<3>().setConstant(200);
    rig.macrostep(rig.set_arm(random_motion(random)));
    Rig twin = rig;
    EffectorCommand wrong = rig.velocity({u(99), u(), u(), u(), u(), u()});
    EXPECT_EQ(rig.macrostep(wrong).verdict, Verdict::refused);
    twin.macrostep();
    for (int k = 0; k < 5; ++k) {
      ASSERT_EQ(rig.last.pwm, twin.last.pwm);
      ASSERT_EQ(rig.driver.set_point().T_0E.p, twin.driver.set_point().T_0E.p);
      ASSERT_EQ(rig.driver.state(), twin.driver.state());
      rig.macrostep();
      twin.macrostep();
    }
  }
}

TEST(DriverInvalid, InvalidCommandsOverEveryFieldAreNeverExecutedAndChangeNothing) {
  const InvalidCount count = count_invalid(kCommands, 2);
  EXPECT_EQ(count.commands, kCommands);
  EXPECT_EQ(count.executed, 0) << count.first;
  EXPECT_EQ(count.changed, 0) << count.first;
}

TEST(DriverInvalid, ArbitraryBytesNeverMakeThePoseOrTheForceNotFinite) {
  std::mt19937_64 random(3);
  Rig rig;
  rig.synchronise();
  for (int k = 0; k < kCommands; ++k) {
    EffectorCommand c;
    std::array<std::uint64_t, sizeof(EffectorCommand) / 8> noise{};
    for (std::uint64_t& word : noise) word = random();
    std::memcpy(static_cast<void*>(&c), noise.data(), noise.size() * 8);
    c.session = 7;
    c.number = rig.driver.protocol().expected();
    c.instruction = static_cast<Instruction>(random() % 8);
    c.robot_model.set_tool = c.robot_model.set_force_tool =
        true;  // a byte that is no bool is the message's affair
    c.robot_model.set_kinematic_model = random() % 2 == 0;
    const EffectorReply reply = rig.macrostep(c);
    for (const double number : reply.T_0E) ASSERT_TRUE(std::isfinite(number)) << k;
    ASSERT_TRUE(finite(reply.F_a));
  }
}

}  // namespace
}  // namespace mrroc::edp::test
