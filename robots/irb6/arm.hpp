// The parts of an IRb-6 that its effector driver uses.
#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "edp/robot.hpp"
#include "robots/irb6/gravity.hpp"
#include "robots/irb6/kinematics.hpp"
#include "robots/irb6/parameters.hpp"
#include "robots/irb6/transmission.hpp"

namespace mrroc::irb6 {

/// One of the two arms; all that differs between them is the table. Every function but the factory is
/// real-time safe.
class Arm final : public edp::Robot {
 public:
  /// @param parameters one of the tables, or a table changed on purpose; it is copied
  explicit Arm(const ArmParameters& parameters);

  [[nodiscard]] int model() const noexcept override { return model_; }
  [[nodiscard]] int models() const noexcept override {
    return family_.empty() ? 1 : static_cast<int>(family_.size());
  }
  /// Arms that make_arm() has made know one another; an arm made of a table of its own knows only itself.
  [[nodiscard]] const edp::Robot* with_model(int number) const noexcept override;

  [[nodiscard]] std::string_view name() const noexcept override { return parameters_.name; }
  [[nodiscard]] int axes() const noexcept override { return parameters_.axis_count(); }
  [[nodiscard]] const edp::AxisProperties& axis(int axis) const noexcept override {
    return parameters_.axes[static_cast<std::size_t>(axis)].properties;
  }
  [[nodiscard]] Pose forward(const AxisVector& joints) const noexcept override {
    return kinematics_.forward(joints);
  }
  [[nodiscard]] edp::InverseSolution inverse(const Pose& T_0W,
                                             const AxisVector& near) const noexcept override {
    return kinematics_.inverse(T_0W, near);
  }
  /// @return the manipulator Jacobian of W in the base (kinematics.hpp)
  [[nodiscard]] Jacobian jacobian(const AxisVector& joints) const noexcept {
    return kinematics_.jacobian(joints);
  }
  /// Outside the domain of the linkages: the motors at the dead centre.
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& joints) const noexcept override {
    return transmission_.motors(joints).value;
  }
  /// Outside the domain of the linkages: the joints at the dead centre.
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& motors) const noexcept override {
    return transmission_.joints(motors).value;
  }

  [[nodiscard]] AxisMatrix motors_per_joints(const AxisVector& joints) const noexcept override {
    return transmission_.jacobian(joints);
  }

  [[nodiscard]] Pose forward_from_motors(const AxisVector& motors) const noexcept override {
    return kinematics_.forward(transmission_.directions(motors));
  }

  [[nodiscard]] AxisVector gravity(const AxisVector& motors) const noexcept override {
    return gravity_.torques(motors, transmission_);
  }

  /// @return the table behind the arm
  [[nodiscard]] const ArmParameters& parameters() const noexcept { return parameters_; }
  /// @return motors to joints and back, with the report of clamping and the Jacobian
  [[nodiscard]] const Transmission& transmission() const noexcept { return transmission_; }
  /// @return T_WS, the force/torque sensor in the wrist
  [[nodiscard]] const Pose& sensor_in_wrist() const noexcept { return T_WS_; }
  /// @return T_WE of the default tool
  [[nodiscard]] const Pose& tool_in_wrist() const noexcept { return T_WE_; }
  /// @return joints of the usual initial pose [rad, track m]
  [[nodiscard]] AxisVector front() const noexcept;
  /// @return joints at which all motors read 0 after synchronisation [rad, track m]
  [[nodiscard]] AxisVector synchronised() const noexcept;

 private:
  ArmParameters parameters_;
  Transmission transmission_;
  Kinematics kinematics_;
  Gravity gravity_;
  Pose T_WS_;
  Pose T_WE_;
  int model_{};
  std::span<const Arm> family_;  // all models of the robot; constant, they live to the end of the program

  friend class Family;
};

/// Makes an arm with one of its kinematic models.
///
/// | number | parameter set | track                                        |
/// | ---    | ---           | ---                                          |
/// | 0      | nominal       | kept                                         |
/// | 1      | calibrated    | kept                                         |
/// | 2, 3   | the same      | last_axis_kept; the arm on the track only    |
/// | 4, 5   | the same      | column_kept; the arm on the track only       |
///
/// @param name  "irb6_postument" or "irb6_track"
/// @param model its number
/// @return the arm, or null for another name or number
[[nodiscard]] std::unique_ptr<Arm> make_arm(std::string_view name, int model = 0);

/// @return number of the model with that parameter set and that rule for the track
[[nodiscard]] constexpr int model_number(ParameterSet set, TrackRule rule = TrackRule::kept) {
  return static_cast<int>(set) + 2 * static_cast<int>(rule);
}

}  // namespace mrroc::irb6
