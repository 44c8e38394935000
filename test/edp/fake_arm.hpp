// A gantry of six axes with coupled and reversed gears, for tests of the effector driver.
#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "edp/robot.hpp"

namespace mrroc::edp::test {

/// Three slides x, y, z and a wrist yaw-pitch-roll: T_0W = [Rz Ry Rx, p]. Singular at pitch = +-pi/2. Motor 0
/// turns against its joint, and motor 5 is coupled to motor 4.
class FakeArm final : public Robot {
 public:
  static constexpr int kAxes = 6;
  static constexpr double kMaxCurrent = 10;   ///< [A]
  static constexpr double kCurrentLimit = 8;  ///< [A]
  static constexpr double kReach = 0.9;       ///< distance of the wrist from the origin [m]
  static constexpr std::array<double, kAxes> kGear{-400, 400, 400, 60, 60, 60};

  FakeArm() {
    for (std::size_t k = 0; k < kAxes; ++k) {
      const bool slide = k < 3;
      axes_[k].name = kNames[k];
      axes_[k].joint = slide ? Range{-0.6, 0.6} : Range{-3, 3};
      axes_[k].motor = slide ? Range{-245, 245} : Range{-200, 200};
      if (k == 5) axes_[k].motor = {-400, 400};
      axes_[k].increments_per_rad = 4000 / (2 * std::numbers::pi);
      axes_[k].max_motor_speed = 250;
      // With the gain of FakeDrives each increment set is made in the next step.
      axes_[k].servo.incremental.fill({.epsilon = 0, .a = 0, .b0 = 0.5, .b1 = 0});
      axes_[k].servo.drive.max_current = kMaxCurrent;
      axes_[k].servo.drive.current_limit = kCurrentLimit;
    }
  }
  [[nodiscard]] std::string_view name() const noexcept override { return "fake"; }
  [[nodiscard]] int axes() const noexcept override { return kAxes; }
  [[nodiscard]] const AxisProperties& axis(int axis) const noexcept override {
    return axes_[static_cast<std::size_t>(axis)];
  }
  [[nodiscard]] Pose forward(const AxisVector& q) const noexcept override {
    return {about(2, q[3]) * about(1, q[4]) * about(0, q[5]), q.head<3>()};
  }
  [[nodiscard]] InverseSolution inverse(const Pose& T, const AxisVector& near) const noexcept override {
    InverseSolution s;
    s.joints = AxisVector::Zero(kAxes);
    s.missing = T.p.norm() - kReach;
    s.reached = s.missing <= 0;  // false for NaN
    if (s.reached) s.missing = 0;
    const double c = std::hypot(T.R(0, 0), T.R(1, 0));
    s.singular = c < 1e-9;
    s.joints.head<3>() = T.p;
    s.joints[3] = s.singular ? near[3] : near_to(std::atan2(T.R(1, 0), T.R(0, 0)), near[3]);
    s.joints[4] = near_to(std::atan2(-T.R(2, 0), c), near[4]);
    const Matrix3 rest = about(2, -s.joints[3]) * T.R;
    s.joints[5] = near_to(std::atan2(-rest(1, 2), rest(1, 1)), near[5]);
    return s;
  }
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& q) const noexcept override {
    AxisVector m(kAxes);
    for (int k = 0; k < kAxes; ++k) m[k] = kGear[static_cast<std::size_t>(k)] * q[k];
    m[5] += m[4];
    return m;
  }
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& m) const noexcept override {
    AxisVector q(kAxes);
    for (int k = 0; k < kAxes; ++k) q[k] = m[k] / kGear[static_cast<std::size_t>(k)];
    q[5] -= m[4] / kGear[5];
    return q;
  }

 private:
  static constexpr std::array<std::string_view, kAxes> kNames{"slide x", "slide y", "slide z",
                                                              "yaw",     "pitch",   "roll"};
  static Matrix3 about(int axis, double angle) {
    Vector3 a = Vector3::Zero();
    a[axis] = angle;
    return rotation_from_angle_axis(a);
  }
  static double near_to(double angle, double near) {
    return near + std::remainder(angle - near, 2 * std::numbers::pi);
  }
  std::array<AxisProperties, kAxes> axes_{};
};

}  // namespace mrroc::edp::test
