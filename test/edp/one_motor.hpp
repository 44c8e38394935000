// A robot of one motor, for tests of servos and drivers.
#pragma once
#include <string_view>

#include "edp/robot.hpp"

namespace mrroc::edp::test {

/// One motor, which is its joint. The pose says nothing.
class OneMotor : public Robot {
 public:
  explicit OneMotor(const AxisProperties& axis) : axis_(axis) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "one"; }
  [[nodiscard]] int axes() const noexcept override { return 1; }
  [[nodiscard]] const AxisProperties& axis(int) const noexcept override { return axis_; }
  [[nodiscard]] Pose forward(const AxisVector&) const noexcept override { return {}; }
  [[nodiscard]] InverseSolution inverse(const Pose&, const AxisVector& near) const noexcept override {
    return {.joints = near, .reached = true};
  }
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& q) const noexcept override { return q; }
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& m) const noexcept override { return m; }

 private:
  AxisProperties axis_;
};

}  // namespace mrroc::edp::test
