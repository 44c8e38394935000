// A robot without a simulator: its motors turn freely. For tests of drivers and for trying a robot's program.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "base/axes.hpp"
#include "base/hardware.hpp"
#include "edp/hardware.hpp"
#include "edp/period_clock.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// Motors of a robot with encoders, switches, currents and friction, as the robot's own DriveModel has them. Weight
/// loads them as the robot says; links have no inertia of their own, and nothing is touched but the stops that a test sets. The force sensor has noise alone; output lines are wired to input lines.
class LoopbackPlant {
 public:
  /// Without a command for so many steps the drives brake by themselves.
  static constexpr int kCommandTimeout = 10;

  /// @param robot   gives number, encoders, ranges and drives of the motors
  /// @param motors  where they stand at the beginning [rad]
  /// @param dt      duration of a step [s]
  LoopbackPlant(const Robot& robot, const AxisVector& motors, double dt);

  /// @return what the sensors say in the present step
  [[nodiscard]] const HardwareReading& reading() const { return reading_; }
  /// One step passes with this command; null: none has come, and the drives go on with the last one for
  /// kCommandTimeout steps.
  void step(const HardwareCommand* command);

  /// A motor meets rigid stops at both ends of this range, from now on: what it moves is blocked there.
  /// @param motor  0..axes - 1  @param free  [rad]; it is there now
  void set_stops(int motor, const Range& free) { free_[static_cast<std::size_t>(motor)] = free; }

  /// @return true positions of the motors [rad]
  [[nodiscard]] const AxisVector& motors() const { return motors_; }
  /// @return whether the drives follow commands; false: they brake
  [[nodiscard]] bool enabled() const { return command_.enabled; }

 private:
  void turn(int motor, double pwm, double load);
  void read_switches(int motor, double before);
  void read();

  const Robot* robot_;
  double dt_;
  AxisVector start_, motors_, speed_, deflection_;  // [rad], [rad], [rad/s], of the friction's spring [rad]
  std::array<Range, kMaxAxes> free_{};              // between the stops [rad]
  std::array<bool, kMaxAxes> limited_{};            // currents of the step, by their drives
  HardwareCommand command_{};
  int silent_{};
  std::uint64_t noise_{1};
  HardwareReading reading_{};
};

/// A LoopbackPlant behind the seam. In lock-step a step passes whenever the driver has commanded one; by the wall clock
/// the periods are those of a PeriodClock, as those of a real robot's driver.
class LoopbackHardware {
 public:
  /// @param plant  with which it begins  @param dt  duration of a step [s]  @param wall  by the wall clock
  LoopbackHardware(LoopbackPlant plant, double dt, bool wall);

  ReadResult read(std::int64_t step);
  void write(const HardwareCommand& command);
  /// @return null in lock-step
  [[nodiscard]] const PeriodClock* clock() const { return clock_ ? &*clock_ : nullptr; }
  /// @return motors as they are after the last step
  [[nodiscard]] const LoopbackPlant& plant() const { return plant_; }

 private:
  LoopbackPlant plant_;
  std::optional<PeriodClock> clock_;
};

static_assert(Hardware<LoopbackHardware>);

}  // namespace mrroc::edp
