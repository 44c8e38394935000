// The shell of a driver of another kind than an arm's: a platform whose driver does nothing but count, behind the link to its
// simulator.
#include "edp/shell_impl.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/msg/convert_platform.hpp"
#include "edp/platform/telemetry_stream.hpp"
#include "edp/protocol.hpp"
#include "edp/recorder_impl.hpp"
#include "edp/simulated_hardware.hpp"
#include "test/base/link/led.hpp"

namespace mrroc::edp::test {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kOwner = 7;
constexpr int kSteps = 10, kReplyStep = 9;

/// Executes everything that its protocol admits.
class CountingDriver {
 public:
  struct Standstill {
    [[nodiscard]] bool at_rest() const { return true; }
    [[nodiscard]] int stop_steps(std::int64_t /*stopped*/) const { return 3; }
  };

  void take(const PlatformCommand& command) {
    taken.push_back(command);
    if (protocol_.admit(command, false).admission != Admission::execute) return;
    protocol_.conclude(command, true);
    reply_.number = command.number;
    reply_.verdict = Verdict::executed;
  }
  PlatformDrive step(const PlatformReading& reading) {
    steps_ = steps_ % kSteps + 1;
    reply_.step = telemetry_.step = reading.step;
    return {.step = reading.step, .torque = {reading.yaw, 0, 0, 0}, .enabled = true};
  }
  void trip(const Fault& fault) { fault_ = fault; }
  void drop_owner() { protocol_.drop_owner(); }
  [[nodiscard]] bool at_boundary() const { return steps_ % kSteps == 0; }
  [[nodiscard]] int macrostep_steps() const { return kSteps; }
  [[nodiscard]] bool reply_due() const { return steps_ == kReplyStep; }
  [[nodiscard]] const PlatformReply& reply() const { return reply_; }
  [[nodiscard]] const PlatformTelemetry& telemetry() const { return telemetry_; }
  [[nodiscard]] DriverState state() const { return DriverState::holding; }
  [[nodiscard]] Standstill standstill() const { return {}; }
  [[nodiscard]] const Fault& fault() const { return fault_; }
  [[nodiscard]] const BasicProtocol<PlatformEffector>& protocol() const { return protocol_; }
  [[nodiscard]] bool owned_by_another(std::int64_t session) const {
    return protocol_.owner() && *protocol_.owner() != session;
  }

  std::vector<PlatformCommand> taken;

 private:
  BasicProtocol<PlatformEffector> protocol_;
  int steps_{};
  PlatformReply reply_;
  PlatformTelemetry telemetry_;
  Fault fault_;
};

struct YawRecord {
  std::int64_t step{};
  FaultCode fault{};
  double yaw{};
  static std::string header() { return "step,yaw\n"; }
  void append(std::string& text, double /*dt*/) const { text += fmt::format("{},{}\n", step, yaw); }
};
YawRecord record_of(const CountingDriver& driver, const PlatformReading& reading,
                    const PlatformDrive& /*d*/) {
  return {reading.step, driver.fault().code, reading.yaw};
}

struct CountingShell {
  using Effector = PlatformEffector;
  using Driver = CountingDriver;
  using Format = OwnFormat<YawRecord>;
  using Stream = TelemetryStream;
  static constexpr std::string_view kSilence = "it counts";
};

class ShellKindTest : public ::testing::Test, protected link::test::Led {
 protected:
  ShellKindTest()
      : Led("edp-rex"),
        states_(mp.outbox<platform_reading_t>("rex.hardware_state", link::Group::servo_state)),
        drives_(mp.inbox<platform_drive_t>("rex.hardware_command", link::Group::servo_command)),
        commands_(mp.outbox<platform_command_t>("rex.command")),
        replies_(mp.inbox<platform_reply_t>("rex.reply")),
        telemetry_(mp.inbox<platform_telemetry_t>("rex.telemetry")) {
    fs::create_directories(folder_);
    begin([this](link::Process& process) {
      const ShellParameters k{.robot = "rex",
                              .ecp = "mp",
                              .recording = Recording::always,
                              .folder = folder_,
                              .start_guard = std::chrono::milliseconds(0)};
      Shell<CountingShell>(process, driver_, SimulatedPlatform(process, "rex", "simulator", k.dt), k, {})
          .run();
    });
    EXPECT_TRUE(run());
  }
  ~ShellKindTest() override {
    end();
    fs::remove_all(folder_);
  }
  /// One step of the simulator. @return the answer of the driver
  PlatformDrive step() {
    PlatformReading r{.step = ++step_, .yaw = 0.5 * static_cast<double>(step_), .imu_valid = true};
    states_->publish(to_message(r), step_);
    EXPECT_TRUE(await([this] { return drives_->at(step_) != nullptr; })) << step_;
    return from_message(*drives_->at(step_));
  }
  void command(std::int64_t macrostep, PlatformCommand c) {
    c.session = kOwner;
    commands_->publish(to_message(c), macrostep);
  }

  fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  CountingDriver driver_;
  std::unique_ptr<link::Outbox<platform_reading_t>> states_;
  std::unique_ptr<link::Inbox<platform_drive_t>> drives_;
  std::unique_ptr<link::Outbox<platform_command_t>> commands_;
  std::unique_ptr<link::Inbox<platform_reply_t>> replies_;
  std::unique_ptr<link::Inbox<platform_telemetry_t>> telemetry_;
  std::int64_t step_{-1};
};

TEST_F(ShellKindTest, EveryStepIsAnsweredEveryMacrostepHasItsCommandReplyAndTelemetry) {
  constexpr std::int64_t kMacrosteps = 6;
  for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
    PlatformCommand c{.number = i, .instruction = i == 3 ? Instruction::keep : Instruction::set};
    if (i > 3) c.number = i - 1;
    c.pace = 1.0 / static_cast<double>(i);
    command(i, c);
  }
  for (int k = 0; k < kSteps * kMacrosteps; ++k) {
    const PlatformDrive drive = step();
    EXPECT_EQ(drive.torque[0], 0.5 * static_cast<double>(step_));
    EXPECT_TRUE(drive.enabled);
    EXPECT_EQ(drive.macrostep, (step_ + 1) / kSteps) << "of the next step";
  }
  for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
    ASSERT_TRUE(await([&] { return replies_->at(i) && telemetry_->at(i); })) << i;
    EXPECT_EQ(replies_->at(i)->step, kSteps * (i - 1) + kReplyStep - 1);
    EXPECT_EQ(telemetry_->at(i)->step, replies_->at(i)->step);
  }
  end();
  ASSERT_EQ(driver_.taken.size(), static_cast<std::size_t>(kMacrosteps) - 1);
  for (std::size_t k = 0; k < driver_.taken.size(); ++k) {
    EXPECT_EQ(driver_.taken[k].macrostep, static_cast<std::int64_t>(k) + 1);
    EXPECT_EQ(driver_.taken[k].pace, 1.0 / static_cast<double>(k + 1)) << "also without a number";
  }
  EXPECT_EQ(driver_.protocol().expected(), kMacrosteps - 1);
}

TEST_F(ShellKindTest, TheOwnersReleaseEndsItAndTheRecordHasEveryStep) {
  command(1, {.number = 1, .instruction = Instruction::set});
  command(2, {.number = 1, .instruction = Instruction::release});
  for (int k = 0; k < 4 * kSteps; ++k) step();
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
  end();
  std::ifstream file(folder_ / "rex-steps.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "step,yaw");
  for (std::int64_t k = 0; k <= step_ - kSteps && std::getline(file, line); ++k)
    EXPECT_EQ(line, fmt::format("{},{}", k, 0.5 * static_cast<double>(k)));
  EXPECT_TRUE(file);
}

TEST_F(ShellKindTest, AnEmergencyStopTripsTheDriver) {
  link::Outbox<operator_order_t> orders(mp.bus(), mp.route("operator"), mp.context().session_id);
  command(1, {});
  step();
  operator_order_t m{};
  m.order = static_cast<std::int32_t>(OperatorOrder::emergency_stop);
  orders.publish(m, 0);
  for (int k = 1; k < kSteps; ++k) step();
  end();
  EXPECT_EQ(driver_.fault().code, FaultCode::emergency_stop);
}

}  // namespace
}  // namespace mrroc::edp::test
