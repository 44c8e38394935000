// Regulators that are exchanged while the motors turn.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "edp/servo.hpp"
#include "robots/irb6/arm.hpp"
#include "sim/motor.hpp"

namespace mrroc::edp::test {
namespace {

constexpr double kDt = 0.002;

/// Six motors with their links, friction and weight, behind one servo.
class Drives {
 public:
  Drives() {
    for (int k = 0; k < arm_.axes(); ++k) {
      const DriveModel& known = arm_.axis(k).servo.drive;
      auto& m = motors_[static_cast<std::size_t>(k)];
      m.resistance = known.resistance;
      m.friction = 0.6 * known.friction;
    }
  }

  void step(double set_increment) {
    AxisVector counted(arm_.axes());
    for (int k = 0; k < arm_.axes(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const std::int32_t now = sim::Encoder(arm_.axis(k).increments_per_rad, 0.3).count(angle_[i]);
      counted[k] = now - count_[i];
      count_[i] = now;
    }
    const AxisVector before = pwm;
    const auto out = servo.step(AxisVector::Constant(arm_.axes(), set_increment), counted,
                                AxisVector::Constant(arm_.axes(), 0.05));
    for (int k = 0; k < arm_.axes(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      pwm[k] = out[i];
      for (int substep = 0; substep < 2; ++substep) {
        const double torque =
            sim::motor_torque(motors_[i], sim::motor_current(motors_[i], pwm[k], speed_[i])) +
            friction_[i].step(motors_[i], speed_[i], kDt / 2) - 0.05;
        speed_[i] += kDt / 2 * torque / arm_.axis(k).servo.drive.inertia;
        angle_[i] += kDt / 2 * speed_[i];
      }
    }
    set += set_increment;
    jump = (pwm - before).cwiseAbs().maxCoeff();
  }

  /// @return largest distance of a shaft from its set position [increments]
  [[nodiscard]] double error() const {
    double worst = 0;
    for (int k = 0; k < arm_.axes(); ++k)
      worst = std::max(worst,
                       std::abs(set - angle_[static_cast<std::size_t>(k)]) * arm_.axis(k).increments_per_rad);
    return worst;
  }
  void select(ServoChoice choice) {
    for (int k = 0; k < arm_.axes(); ++k)
      ASSERT_TRUE(servo.select(k, choice.algorithm_no, choice.parameter_set_no));
  }

 private:
  irb6::Arm arm_{irb6::kPostument};
  std::array<sim::MotorParameters, kMaxAxes> motors_{};
  std::array<sim::ShaftFriction, kMaxAxes> friction_{};
  std::array<double, kMaxAxes> angle_{}, speed_{};
  std::array<std::int32_t, kMaxAxes> count_{};

 public:
  Servo servo{arm_, 0.002};
  AxisVector pwm = AxisVector::Zero(6);
  double set{};   // [rad]
  double jump{};  // of the duty cycle in the last step
};

// A smooth motion to and fro, at most 10 rad/s.
double increment(int step) { return 0.02 * std::sin(2 * M_PI * step / 700); }

double worst_error_of_the_original() {
  Drives drives;
  drives.select({0, 0});
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    drives.step(increment(k));
    if (k >= 1000) worst = std::max(worst, drives.error());
  }
  return worst;
}

TEST(ServoSwitch, NeitherStepsTheDutyCycleNorLosesThePosition) {
  std::mt19937_64 random(1);
  Drives drives;
  double noise = 0, behind = 0, switched = 0;
  ServoChoice now{0, 0};
  drives.select(now);
  for (int k = 0; k < 20'000; ++k) {
    const bool exchange = k > 1000 && random() % 200 == 0;
    if (exchange) {
      now = {static_cast<int>(random() % kServoAlgorithms), 0};
      drives.select(now);
      ASSERT_EQ(drives.servo.selected(2), now);
    }
    drives.step(increment(k));
    if (k < 1000) continue;
    behind = std::max(behind, drives.error());
    (exchange ? switched : noise) = std::max(exchange ? switched : noise, drives.jump);
  }
  EXPECT_LE(switched, noise) << "duty cycle";
  for (int k = 0; k < 2000; ++k) drives.step(0);
  EXPECT_LT(drives.error(), 3) << "where it is set to be, after a hundred exchanges";
  EXPECT_LT(behind, 1.2 * worst_error_of_the_original());
}

TEST(ServoSwitch, ParameterSetIsExchangedUnderWeight) {
  for (int algorithm = 0; algorithm < kServoAlgorithms; ++algorithm) {
    Drives drives;
    drives.select({algorithm, 0});
    for (int k = 0; k < 1500; ++k) drives.step(0);
    const double before = drives.error();
    for (int k = 0; k < 20; ++k) {
      drives.select({algorithm, (k + 1) % 2});
      drives.step(0);
      EXPECT_LT(drives.jump, 4) << algorithm;
      for (int i = 0; i < 20; ++i) drives.step(0);
      EXPECT_LT(drives.error(), before + 2) << algorithm;
    }
  }
}

TEST(ServoSwitch, UnknownRegulatorsAndMotorsAreRefused) {
  Drives drives;
  const ServoChoice before = drives.servo.selected(3);
  for (const auto& [motor, algorithm, set] :
       {std::tuple{6, 0, 0}, {-1, 0, 0}, {3, 2, 0}, {3, -1, 0}, {3, 0, 2}, {3, 1, -1}, {1 << 30, 1 << 30, 0}})
    EXPECT_FALSE(drives.servo.select(motor, algorithm, set)) << motor << ' ' << algorithm << ' ' << set;
  EXPECT_EQ(drives.servo.selected(3), before);
  EXPECT_TRUE(Servo::known(1, 1));
}

}  // namespace
}  // namespace mrroc::edp::test
