// The hardware of a simulated robot, and its simulator in the same thread.
#include "edp/simulated_hardware.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "base/fault.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::edp {
namespace {

class SimulatedHardwareTest : public ::testing::Test {
 protected:
  void begin(ClockKind clock, double dt = 0.002) {
    link::NodeContext m{.session = "s", .session_id = 1, .name = "edp", .roster = {"mp", "edp", "world"}};
    m.clock = clock;
    // A run of its own: what speaks through a process ends before it, and what listens with its bus.
    hardware.reset();
    states.reset();
    commands.reset();
    supervisor.reset();
    process.reset();
    bus.emplace();
    process.emplace(*bus, m);
    hardware.emplace(*process, "arm1", "world", dt);
    states.emplace(*bus, process->route("arm1.hardware_state", link::Group::servo_state), 1);
    commands.emplace(*bus, process->route("arm1.hardware_command", link::Group::servo_command), 1);
    supervisor.emplace(*bus, process->route("supervisor"), 1);
    say(link::Phase::running);
  }
  void say(link::Phase phase, std::int64_t dead = 0) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    m.dead = dead;
    supervisor->publish(m, 0);
  }
  void simulate(std::int64_t step, std::int64_t begun = 0) {
    hardware_state_t m{};
    m.encoder[2] = static_cast<std::int32_t>(100 + step);
    m.current[1] = 0.5;
    m.begun = begun;
    states->publish(m, step);
  }

  std::optional<link::test::DirectBus> bus;
  std::optional<link::Process> process;
  std::optional<SimulatedHardware> hardware;
  std::optional<link::Outbox<hardware_state_t>> states;
  std::optional<link::Queue<hardware_command_t>> commands;
  std::optional<link::Outbox<supervisor_t>> supervisor;
};

TEST_F(SimulatedHardwareTest, InLockStepGivesTheReadingOfTheStep) {
  begin(ClockKind::step);
  simulate(5, 7);
  simulate(6);
  const ReadResult five = hardware->read(5), six = hardware->read(6);
  EXPECT_EQ(five.status, ReadStatus::reading);
  EXPECT_EQ(five.reading.step, 5);
  EXPECT_EQ(five.reading.encoder[2], 105);
  EXPECT_EQ(five.reading.current[1], 0.5);
  EXPECT_EQ(five.begun, 7);
  EXPECT_EQ(six.reading.encoder[2], 106);
  EXPECT_EQ(six.begun, std::numeric_limits<std::int64_t>::max()) << "it was not told";
}

TEST_F(SimulatedHardwareTest, ByTheWallClockGivesTheNewestReadingOrNoneAfterTheTimeOfAStep) {
  begin(ClockKind::wall, 0.03);
  simulate(5);
  simulate(8);
  EXPECT_EQ(hardware->read(6).reading.step, 8);
  EXPECT_EQ(hardware->read(8).reading.step, 8);
  const auto begun = link::Process::Clock::now();
  EXPECT_EQ(hardware->read(9).status, ReadStatus::silent);
  const auto took = link::Process::Clock::now() - begun;
  EXPECT_GE(took, std::chrono::milliseconds(30));
  EXPECT_LT(took, std::chrono::seconds(5));
}

TEST_F(SimulatedHardwareTest, EndsWithItsSystemOrItsSimulator) {
  for (const ClockKind clock : {ClockKind::step, ClockKind::wall}) {
    begin(clock);
    say(link::Phase::stopping);
    simulate(1);
    EXPECT_EQ(hardware->read(1).status, ReadStatus::reading) << "it goes on to the end";
    say(link::Phase::running, 0b100);
    EXPECT_EQ(hardware->read(2).status, ReadStatus::ended) << "the simulator is dead";
    begin(clock);
    say(link::Phase::running, 0b010);
    simulate(1);
    EXPECT_EQ(hardware->read(1).status, ReadStatus::reading) << "another one is";
    say(link::Phase::finished);
    EXPECT_EQ(hardware->read(2).status, ReadStatus::ended);
  }
}

TEST_F(SimulatedHardwareTest, SendsTheCommandOfItsStep) {
  begin(ClockKind::step);
  HardwareCommand command{};
  command.step = 12;
  command.pwm[3] = -0.25;
  command.enabled = true;
  hardware->write(command);
  const auto m = commands->take();
  ASSERT_TRUE(m);
  EXPECT_EQ(m->header.stamp, 12);
  EXPECT_EQ(from_message(*m).pwm[3], -0.25);
  EXPECT_TRUE(from_message(*m).enabled);
  EXPECT_FALSE(commands->take());
}

}  // namespace
}  // namespace mrroc::edp
