// What a platform's drives do when their driver is silent.
#pragma once
#include "edp/platform/wheel_brake.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// The fault reaction of the drives themselves, as makers build it in: those that were driving brake by a torque against the speed
/// that their encoders show, until the wheels rest; then, and where none was driving, the motors are short-circuited. That alone
/// would fade with the speed: from 0.8 m/s it takes 0.9 s. Real-time safe.
class QuickStop {
 public:
  explicit QuickStop(const robots::SkidSteerParameters& body)
      : properties_{.name = "drives",
                    .increments_per_turn = body.increments_per_turn,
                    .max_torque = body.max_torque,
                    .braking_torque = body.quick_stop,
                    .max_wheel_speed = body.no_torque_speed},
        wheels_(body.increments_per_turn, kPlatformStep),
        brake_(properties_, kPlatformStep) {}

  /// A step's reading, before its brake().
  void measure(const PlatformReading& reading) { wheels_.step(reading); }
  /// A step without a command. @param drive  of the last command, or what this function made of it
  void brake(PlatformDrive& drive) {
    if (drive.step != since_) {
      since_ = drive.step;
      brake_.end();
      if (drive.enabled) brake_.begin();
    }
    drive.torque = brake_.step(wheels_);
    drive.enabled = brake_.engaged();
  }

 private:
  edp::PlatformProperties properties_;
  edp::WheelMeter wheels_;
  edp::WheelBrake brake_;
  std::int64_t since_{-1};  // step of the last command
};

}  // namespace mrroc::sim
