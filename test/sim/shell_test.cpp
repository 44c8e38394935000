// The simulator's shell among the programs of its system: which robots it serves.
#include "sim/shell/shell.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "base/msg/convert.hpp"
#include "robots/irb6/robot_type.hpp"
#include "test/base/link/led.hpp"

namespace mrroc::sim {
namespace {

/// A simulator of two arms, of which the second one's hardware is another plant; the test is the first one's driver.
class SimulatorShell : public ::testing::Test, protected link::test::Led {
 protected:
  SimulatorShell()
      : Led("simulator"),
        commands_(mp.outbox<hardware_command_t>("arm1.hardware_command", link::Group::servo_command)),
        served_(mp.inbox<hardware_state_t>("arm1.hardware_state", link::Group::servo_state)),
        others_(mp.inbox<hardware_state_t>("arm2.hardware_state", link::Group::servo_state)) {
    begin([](link::Process& process) {
      WorldParameters parameters;
      parameters.arms.assign(2, arm_parameters(irb6::postument()));
      parameters.arms[1].T_UB.p.y() = 3;
      World world(parameters, 1);
      ShellParameters k;
      k.robots = {"arm1", "arm2"};
      k.drivers = {"edp-arm1", ""};
      run_simulator(process, {.arms = &world}, k);
    });
    EXPECT_TRUE(run());
  }
  ~SimulatorShell() override { end(); }

  std::unique_ptr<link::Outbox<hardware_command_t>> commands_;
  std::unique_ptr<link::Inbox<hardware_state_t>> served_, others_;
};

TEST_F(SimulatorShell, SaysNothingOfTheHardwareOfARobotThatItDoesNotSimulate) {
  for (std::int64_t step = 0; step < 5; ++step) {
    ASSERT_TRUE(await([&] { return served_->at(step) != nullptr; })) << step;
    commands_->publish(to_message(HardwareCommand{}), step);
  }
  EXPECT_FALSE(others_->newest());
}

}  // namespace
}  // namespace mrroc::sim
