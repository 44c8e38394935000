// The interface between the kernel of a robot and the effector driver's shell.
#pragma once
#include <array>
#include <optional>
#include <string_view>

#include "base/axes.hpp"
#include "base/pose.hpp"
#include "edp/servo_coefficients.hpp"

namespace mrroc::edp {

/// Interval of legal values of one axis.
struct Range {
  double lower{};  ///< smallest legal value
  double upper{};  ///< largest legal value
  /// @return false also for NaN
  [[nodiscard]] constexpr bool contains(double x) const { return x >= lower && x <= upper; }
};

/// Constant properties of one axis.
struct AxisProperties {
  std::string_view name;      ///< for messages: "column", "lower arm", ...
  Range joint;                ///< legal joint position [rad], track: [m]
  Range motor;                ///< legal motor position [rad]
  double increments_per_rad;  ///< encoder increments per radian of the motor shaft
  double max_motor_speed;     ///< [rad/s] of the motor shaft
  ServoCoefficients servo;    ///< all regulators of the motor, and its drive
};

/// Result of the inverse kinematics problem.
struct InverseSolution {
  AxisVector joints;  ///< [rad], track: [m]; meaningful when reached
  bool reached{};     ///< the pose lies within reach; the caller compares the joints with their limits
  double missing{};   ///< distance by which the wrist is out of reach [m], 0 when reached; infinite when the
                      ///< arguments are no pose and joints of the robot
  bool singular{};    ///< joints not determined by the pose (wrist or column) are those of the branch given
};

/// A robot with one of its kinematic models: kinematics, transmissions and limits. It never changes; another
/// model of the same robot is another object. Every function is real-time safe: no allocation, no exception.
class Robot {
 public:
  virtual ~Robot() = default;

  /// @return number of this kinematic model, the parameter_set_no of SET ROBOT_MODEL KINEMATIC_MODEL
  [[nodiscard]] virtual int model() const noexcept { return 0; }
  /// @return how many kinematic models the robot has, at least 1
  [[nodiscard]] virtual int models() const noexcept { return 1; }
  /// @param number any number
  /// @return the same robot with that kinematic model, or null if there is none of that number. It lives at
  ///         least as long as this one and has the same name, axes and motor limits. A motor position is the
  ///         same with all models, the joints and the pose that it stands for are not.
  [[nodiscard]] virtual const Robot* with_model(int number) const noexcept {
    return number == 0 ? this : nullptr;
  }

  /// @return name, as in the configuration
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// @return number of axes, 1..kMaxAxes
  [[nodiscard]] virtual int axes() const noexcept = 0;
  /// @param axis 0..axes()-1
  [[nodiscard]] virtual const AxisProperties& axis(int axis) const noexcept = 0;
  /// Direct kinematics. @param joints [rad], track [m] @return T_0W, wrist in the base
  [[nodiscard]] virtual Pose forward(const AxisVector& joints) const noexcept = 0;
  /// Inverse kinematics. @param T_0W wrist in the base @param near joints that choose the branch
  [[nodiscard]] virtual InverseSolution inverse(const Pose& T_0W, const AxisVector& near) const noexcept = 0;
  /// Transmission. @param joints [rad], track [m] @return motor positions [rad]
  [[nodiscard]] virtual AxisVector motors_from_joints(const AxisVector& joints) const noexcept = 0;
  /// Transmission, inverse. @param motors [rad] @return joints [rad], track [m]
  [[nodiscard]] virtual AxisVector joints_from_motors(const AxisVector& motors) const noexcept = 0;
  /// Jacobian of the transmission, d(motors)/d(joints). Differences, exact where the gears are linear; a robot may
  /// know better. @param joints [rad], track [m]
  [[nodiscard]] virtual AxisMatrix motors_per_joints(const AxisVector& joints) const noexcept {
    constexpr double kHalf = 1e-5;  // [rad, m]
    AxisMatrix J(axes(), axes());
    for (int k = 0; k < axes(); ++k) {
      AxisVector before = joints, behind = joints;
      before[k] -= kHalf;
      behind[k] += kHalf;
      J.col(k) = (motors_from_joints(behind) - motors_from_joints(before)) / (2 * kHalf);
    }
    return J;
  }
  /// Direct kinematics and inverse transmission at once, which a robot may know how to do with less.
  /// @param motors [rad] @return T_0W, wrist in the base
  [[nodiscard]] virtual Pose forward_from_motors(const AxisVector& motors) const noexcept {
    return forward(joints_from_motors(motors));
  }
  /// Torques of the motors that hold the arm with its usual tool still against gravity. Nominal: what is wrong
  /// or missing here is left to the servo. @param motors [rad] @return [N m], per motor
  [[nodiscard]] virtual AxisVector gravity(const AxisVector& motors) const noexcept {
    return AxisVector::Zero(motors.size());
  }
};

}  // namespace mrroc::edp
