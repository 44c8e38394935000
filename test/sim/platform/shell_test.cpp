// The simulator's shell with a platform: what it tells its driver, the map agent and the viewers, in lock-step.
#include "sim/shell/shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "base/msg/convert_platform.hpp"
#include "base/platform_path.hpp"
#include "mrroc/simulation_control_t.hpp"
#include "sim/platform/platform_world.hpp"
#include "test/base/link/led.hpp"
#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

using test::drive;

PlatformWorldParameters noisy_world() {
  PlatformWorldParameters p = test::ideal_world();
  p.platforms[0].imu = {};
  p.platforms[0].load_cells = {};
  p.platforms[0].body.quick_stop = 0;  // as the twin's drives
  p.motion_capture.noise = {0.005, 0.01};
  p.motion_capture.setup = {.period = 30, .latency = 10};
  p.boxes = {{.name = "crate", .start = {.x = 0.75, .y = 0.1, .phi = 0.2}}};
  return p;
}

/// A simulator of one platform; the test is its driver and everybody else.
class PlatformShell : public ::testing::Test, protected link::test::Led {
 protected:
  PlatformShell()
      : Led("simulator"),
        drives_(mp.outbox<platform_drive_t>("rex.hardware_command", link::Group::servo_command)),
        control_(mp.outbox<simulation_control_t>("simulation.control")),
        readings_(mp.inbox<platform_reading_t>("rex.hardware_state", link::Group::servo_state)),
        captured_(mp.inbox<motion_capture_t>("rex.motion_capture")),
        truth_(mp.inbox<platform_truth_t>("rex.truth")),
        box_captured_(mp.inbox<motion_capture_t>("crate.motion_capture")),
        box_truth_(mp.inbox<box_truth_t>("crate.truth")) {
    begin([](link::Process& process) {
      PlatformWorld world(noisy_world(), 3);
      ShellParameters k;
      k.platforms = {"rex"};
      k.platform_drivers = {"edp-rex"};
      k.boxes = {"crate"};
      run_simulator(process, {.platforms = &world}, k);
    });
    EXPECT_TRUE(run());
  }
  ~PlatformShell() override { end(); }

  /// One step as its driver. @return whether the reading came, and is that of a world that is driven alike
  [[nodiscard]] bool step(PlatformDrive d) {
    const std::int64_t step = twin_.steps();
    if (!await([&] { return readings_->at(step) != nullptr; })) return false;
    const PlatformReading reading = from_message(*readings_->at(step));
    const PlatformReading& expected = twin_.reading(0);
    EXPECT_EQ(reading.step, step);
    EXPECT_EQ(reading.encoder, expected.encoder) << step;
    EXPECT_EQ(reading.yaw, expected.yaw) << step;
    EXPECT_EQ(reading.load, expected.load) << step;
    check_others(step);
    d.macrostep = (step + 1) / kPlatformSteps;
    drives_->publish(to_message(d), step);
    if (std::isnan(d.torque[0])) d.enabled = false;
    twin_.step({&d, 1});
    return true;
  }

  std::int64_t heard_{};  // readings of motion capture

 private:
  void check_others(std::int64_t step) {
    if (const auto& captured = twin_.motion_capture(0)) {
      ASSERT_TRUE(await([&] { return captured_->at(captured->number) != nullptr; })) << step;
      const MotionCapture told = from_message(*captured_->at(captured->number));
      EXPECT_EQ(told.step, captured->reading.step);
      EXPECT_EQ(told.p.x, captured->reading.p.x);
      ++heard_;
    }
    if (const auto& captured = twin_.box_motion_capture(0)) {
      ASSERT_TRUE(await([&] { return box_captured_->at(captured->number) != nullptr; })) << step;
      EXPECT_EQ(from_message(*box_captured_->at(captured->number)).p.x, captured->reading.p.x);
    }
    if (step % kPlatformSteps != 0) return;
    const std::int64_t macrostep = step / kPlatformSteps;
    ASSERT_TRUE(await([&] { return truth_->at(macrostep) != nullptr; })) << step;
    EXPECT_EQ(from_message(*truth_->at(macrostep)).p.x, twin_.truth(0).p.x);
    ASSERT_TRUE(await([&] { return box_truth_->at(macrostep) != nullptr; })) << step;
    const BoxTruth box = from_message(*box_truth_->at(macrostep));
    EXPECT_EQ(box.p.x, twin_.box_truth(0).p.x);
    EXPECT_EQ(box.push[0], twin_.box_truth(0).push[0]);
    control_->publish({}, macrostep + 1);
  }

  PlatformWorld twin_{noisy_world(), 3};
  std::unique_ptr<link::Outbox<platform_drive_t>> drives_;
  std::unique_ptr<link::Outbox<simulation_control_t>> control_;
  std::unique_ptr<link::Inbox<platform_reading_t>> readings_;
  std::unique_ptr<link::Inbox<motion_capture_t>> captured_;
  std::unique_ptr<link::Inbox<platform_truth_t>> truth_;
  std::unique_ptr<link::Inbox<motion_capture_t>> box_captured_;
  std::unique_ptr<link::Inbox<box_truth_t>> box_truth_;
};

TEST_F(PlatformShell, TellsWhatTheWorldMeasures) {
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(step(drive({5, 6, 5, 6}))) << k;
  EXPECT_EQ(heard_, 10);
}

TEST_F(PlatformShell, BrakesThePlatformInAStepWithoutAProperCommand) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 100; ++k) {
    // The driver counts macrosteps, so its command is a proper one at the end of each.
    const bool broken = k > 50 && k % kPlatformSteps < kPlatformSteps - 1;
    ASSERT_TRUE(step(drive({broken ? kNoNumber : 8, 8, 8, 8}))) << k;
  }
}

}  // namespace
}  // namespace mrroc::sim
