// With the wall clock nobody waits for what is late: whoever has been interrupted goes on with what is newest.
#include <gtest/gtest.h>

#include "test/mp/chain.hpp"

namespace mrroc::mp {
namespace {

using test::Chain;

/// Runs 40 macrosteps, the member interrupted in the fifteenth.
Outcome run(Chain& chain, std::int64_t* macrosteps = nullptr) {
  return chain.run(
      60, [](std::int64_t) { return 0.001; },
      [&](std::int64_t i, const Report&) {
        if (i >= 15) chain.interrupt();
        if (macrosteps) ++*macrosteps;
      });
}

class Interrupted : public ::testing::TestWithParam<const char*> {};

TEST_P(Interrupted, GoesOnAndTheTaskComesToItsEnd) {
  Chain chain({}, ClockKind::wall);
  chain.rests = GetParam();
  chain.rest_for = std::chrono::milliseconds(400);  // more than the inboxes hold of the servo's messages
  EXPECT_EQ(run(chain), Outcome::terminated) << chain.links.fault().text.view();
  EXPECT_FALSE(chain.supervisor.fault()) << chain.lines();
  EXPECT_NE(chain.lines().find("skipped"), std::string::npos) << chain.lines();
}
INSTANTIATE_TEST_SUITE_P(WallClock, Interrupted, ::testing::Values("simulator", "edp-arm1", "ecp-arm1"),
                         [](const auto& member) {
                           std::string name = member.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(WallClock, ASimulatorThatIsSilentForTooLongIsANamedFault) {
  Chain chain({}, ClockKind::wall);
  chain.rests = "simulator";
  chain.rest_for = std::chrono::milliseconds(400);
  chain.state_timeout = 50;
  EXPECT_NE(run(chain), Outcome::terminated);
  ASSERT_TRUE(chain.supervisor.fault());
  EXPECT_EQ(chain.supervisor.fault()->code, FaultCode::hardware_silent);
  EXPECT_EQ(chain.supervisor.fault()->process.view(), "edp-arm1");
}

TEST(WallClock, NobodyReleasesADriverForItsOwner) {
  Chain chain({}, ClockKind::wall);
  bool sent = false;
  const Outcome outcome = chain.run(
      60, [](std::int64_t) { return 0.001; },
      [&](std::int64_t i, const Report&) {
        if (i < 15 || sent) return;
        sent = true;
        effector_command_t release{};
        while (const auto command = chain.commands.take()) release = *command;
        release.header.number += 3;
        ++release.session;
        release.instruction = static_cast<std::int8_t>(Instruction::release);
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<effector_command_t>()));
        release.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
        chain.mp.bus().publish(chain.mp.route("arm1.command"), bytes);
      });
  EXPECT_TRUE(sent);
  EXPECT_EQ(outcome, Outcome::terminated) << chain.links.fault().text.view();
  EXPECT_FALSE(chain.supervisor.fault()) << chain.lines();
}

TEST(WallClock, AnArmWithoutOrdersHoldsAndSaysSo) {
  Chain chain({}, ClockKind::wall);
  chain.rests = "ecp-arm1";
  chain.rest_for = std::chrono::milliseconds(200);
  EXPECT_EQ(run(chain), Outcome::terminated);
  EXPECT_NE(chain.lines().find("the arm comes to rest"), std::string::npos) << chain.lines();
}

}  // namespace
}  // namespace mrroc::mp
