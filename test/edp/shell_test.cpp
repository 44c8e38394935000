// The shell of an effector driver between its hardware and its macrosteps: who may end it.
#include "edp/shell.hpp"

#include <gtest/gtest.h>

#include "base/msg/convert.hpp"
#include "mrroc/effector_command_t.hpp"
#include "mrroc/step_samples_t.hpp"
#include "test/base/link/led.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr std::int64_t kOwner = 7, kStranger = 9;

/// An ideal robot in lock-step: it waits for nobody.
struct IdealRobot {
  FakeWorld* world;
  ReadResult read(std::int64_t step) const {
    ReadResult result{.status = ReadStatus::reading, .reading = world->reading()};
    result.reading.step = step;
    return result;
  }
  void write(const HardwareCommand& command) const { world->apply(command); }
};

class EdpShell : public ::testing::Test, protected link::test::Led {
 protected:
  EdpShell()
      : Led("edp-arm1"),
        commands_(mp.outbox<effector_command_t>("arm1.command")),
        replies_(mp.inbox<effector_reply_t>("arm1.reply")),
        samples_(mp.inbox<step_samples_t>("arm1.samples")) {
    begin([this](link::Process& process) {
      run_edp(process, rig_.driver, IdealRobot{&rig_.world},
              {.robot = "arm1", .ecp = "mp", .start_guard = std::chrono::milliseconds(0)});
    });
    EXPECT_TRUE(run());
  }
  ~EdpShell() override { end(); }

  /// Gives the command of the next macrostep. @return whether the driver has gone through that macrostep
  bool macrostep(Instruction instruction, std::int64_t session = kOwner) {
    EffectorCommand c = rig_.command(instruction);
    c.session = session;
    c.number = session == kOwner ? ++number_ : 1;
    commands_->publish(to_message(c), ++i_);
    return await([this] { return replies_->at(i_ + 1) != nullptr && samples_->at(i_ + 1) != nullptr; });
  }
  [[nodiscard]] bool last() const { return samples_->at(i_ + 1)->last != 0; }

  Rig rig_;
  std::int64_t i_{}, number_{};
  std::unique_ptr<link::Outbox<effector_command_t>> commands_;
  std::unique_ptr<link::Inbox<effector_reply_t>> replies_;
  std::unique_ptr<link::Inbox<step_samples_t>> samples_;
};

TEST_F(EdpShell, AReleaseByASessionThatDoesNotOwnTheArmChangesNothing) {
  ASSERT_TRUE(macrostep(Instruction::synchro));
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(macrostep(Instruction::keep));
  ASSERT_TRUE(macrostep(Instruction::release, kStranger));
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(macrostep(Instruction::keep)) << k << " macrosteps after it";
    EXPECT_FALSE(last());
    EXPECT_FALSE(ended());
  }
  EXPECT_TRUE(rig_.driver.owned_by_another(kStranger)) << "the owner has the arm as before";
}

TEST_F(EdpShell, TheOwnersReleaseEndsTheDriverInTheMacrostepAfterIt) {
  ASSERT_TRUE(macrostep(Instruction::synchro));
  ASSERT_TRUE(macrostep(Instruction::release));
  EXPECT_FALSE(last());
  ++i_;
  EXPECT_TRUE(await([this] { return samples_->at(i_ + 1) != nullptr && samples_->at(i_ + 1)->last != 0; }));
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

}  // namespace
}  // namespace mrroc::edp::test
