// Homing: finds the positions of motors whose encoders count from an unknown position.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "base/fault.hpp"
#include "base/hardware.hpp"
#include "edp/driver_parameters.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// Homing of a whole robot, one axis after the other, in the way of the original framework:
///
///  1. a pressed switch is left at the coarse speed (it is pressed on the whole lower side, so its state tells
///     on which side the axis is)
///  2. the axis moves at the coarse speed to the switch and comes to rest
///  3. it stands still
///  4. it leaves the switch at the fine speed; the first zero mark of the encoder after that is the place
///     where the motor position is AxisHoming::position
///  5. it settles, and the next axis begins
///  6. with HomingParameters::returns, every axis goes back to where it stood at the beginning, the last one
///     first: the way back is the way that it has come
///
/// The switch is believed when two readings in succession agree. An axis never moves farther than
/// its legal range. Nothing is known about positions until all axes are done. Real-time safe.
class Homing {
 public:
  /// @param robot must live longer than the homing @param dt duration of a step [s]
  Homing(const Robot& robot, const HomingParameters& parameters, double dt) noexcept;

  /// Begins with the first axis, at rest.
  void start() noexcept;

  /// One step: looks at the switches, decides how the set points of the motors move.
  /// @return the malfunction that makes it impossible: synchro_switch_missing, synchro_switch_stuck or
  ///         encoder_index_missing, with the axis
  [[nodiscard]] std::optional<Fault> step(const HardwareReading& reading) noexcept;

  /// @return motion of the set points in this step [rad]; one per axis, all but one of them 0
  [[nodiscard]] const AxisVector& increment() const noexcept { return increment_; }
  /// @return whether all axes are done, and are back if they are to return
  [[nodiscard]] bool done() const noexcept {
    return found() && axes_back_ == (p_.returns ? robot_->axes() : 0);
  }
  /// @return axis that is being homed, or goes back
  [[nodiscard]] int axis() const noexcept {
    const int place = found() ? robot_->axes() - 1 - axes_back_ : axes_done_;
    return (p_.first_axis + place) % robot_->axes();
  }
  /// @return count of an axis' encoder at its position AxisHoming::position; meaningful when done
  [[nodiscard]] std::int32_t count(int axis) const noexcept { return count_[static_cast<std::size_t>(axis)]; }

 private:
  enum class Phase : std::uint8_t { begin, leave, search, stand, release, index, settle, back };

  [[nodiscard]] bool found() const noexcept { return axes_done_ == robot_->axes(); }

  void enter(Phase phase) noexcept;
  [[nodiscard]] std::optional<Fault> move(const HardwareReading& reading) noexcept;
  void end_axis() noexcept;
  void go_back() noexcept;
  [[nodiscard]] double range() const noexcept;
  /// The set point's speed comes nearer to a speed, in ramp_steps from rest to the coarse one.
  void approach(double speed) noexcept;
  [[nodiscard]] Fault fault(FaultCode code, double limit) const noexcept;

  const Robot* robot_;
  HomingParameters p_;
  double dt_;
  Phase phase_{};
  int axes_done_{};
  int axes_back_{};
  int steps_{};         // in the phase
  double travelled_{};  // in the phase [rad]
  double speed_{};      // of the set point [rad/s]
  bool pressed_{};      // the switch, believed
  bool last_sample_{};
  AxisVector increment_;
  AxisVector way_;  // of the set points since start() [rad]
  std::array<std::int32_t, kMaxAxes> count_{};
};

}  // namespace mrroc::edp
