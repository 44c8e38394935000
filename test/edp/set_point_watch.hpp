// Watches the set motor positions of a rig for jumps.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "test/edp/rig.hpp"

namespace mrroc::edp::test {

/// Watches the set motor positions for jumps.
class SetPointWatch {
 public:
  explicit SetPointWatch(Rig& rig) : rig_(rig), before_(rig.driver.set_point().axes.motors) {
    rig.after_each_step = [this] { look(); };
  }
  ~SetPointWatch() { rig_.after_each_step = nullptr; }
  SetPointWatch(const SetPointWatch&) = delete;
  SetPointWatch& operator=(const SetPointWatch&) = delete;

  AxisVector speed = AxisVector::Zero(FakeArm::kAxes);  ///< last increments [rad]
  double worst_acceleration{};  ///< largest change of an increment since start() [rad]
  int moving_steps{};           ///< steps since start() in which anything moved

  void start() {
    worst_acceleration = 0;
    moving_steps = 0;
  }

 private:
  void look() {
    const AxisVector& now = rig_.driver.set_point().axes.motors;
    const AxisVector increment = now - before_;
    worst_acceleration = std::max(worst_acceleration, (increment - speed).cwiseAbs().maxCoeff());
    moving_steps += (increment.array() != 0).any();
    speed = increment;
    before_ = now;
    // What the servo is told is what the set point does.
    EXPECT_LT((increment - rig_.driver.set_point().motor_increment).cwiseAbs().maxCoeff(), 1e-9);
  }
  Rig& rig_;
  AxisVector before_;
};

}  // namespace mrroc::edp::test
