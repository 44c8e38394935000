// The driver with the two real arms' kinematics, transmissions and limits, and drives that follow ideally.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/representation.hpp"
#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "test/base/random_pose.hpp"
#include "test/edp/guard_count.hpp"

namespace mrroc::edp {
namespace {

using mrroc::test::distance;
using mrroc::test::random_direction;
using mrroc::test::uniform;

class Irb6Driver : public testing::TestWithParam<const char*> {
 protected:
  Irb6Driver() : arm(irb6::make_arm(GetParam())), joints(arm->front()) {
    // Tool down, in the middle of the workspace.
    joints[arm->axes() - 3] = 0;
    joints[arm->axes() - 2] = 1.5 * std::numbers::pi;
    joints[arm->axes() - 1] = 0;
    start = arm->motors_from_joints(joints);
  }

  DriverParameters parameters() const {
    DriverParameters p;
    p.synchro_joints = joints;
    p.T_WE = arm->tool_in_wrist();
    p.force.T_WS = arm->sensor_in_wrist();
    p.supervision.torque_steps = std::numeric_limits<int>::max();  // the motors of this test need no torque
    p.limits.linear_acceleration = p.limits.angular_acceleration = p.limits.motor_acceleration = 1e6;
    return p;
  }
  /// A driver that knows where it is.
  Driver synchronised() {
    Driver driver(*arm, parameters());
    reading = {};
    command = {};
    command.session = 1;
    command.instruction = Instruction::synchro;
    macrostep(driver, true);
    command.instruction = Instruction::set;
    command.set = static_cast<std::uint8_t>(Part::arm);
    return driver;
  }
  void macrostep(Driver& driver, bool commanded) {
    if (commanded) {
      ++command.number;
      driver.take(command);
    }
    do {
      const AxisVector before = driver.set_point().motor_increment;
      driver.step(reading);
      const SetPoint& set = driver.set_point();
      acceleration = (set.motor_increment - before).cwiseAbs().maxCoeff();
      worst_acceleration = std::max(worst_acceleration, acceleration);
      for (int k = 0; k < arm->axes(); ++k) {
        const AxisProperties& axis = arm->axis(k);
        reading.encoder[static_cast<std::size_t>(k)] =
            static_cast<std::int32_t>(std::lround((set.axes.motors[k] - start[k]) * axis.increments_per_rad));
        if (driver.state() == DriverState::not_synchronised) continue;
        const double slack = 1e-6;
        EXPECT_GE(set.axes.motors[k], axis.motor.lower - slack);
        EXPECT_LE(set.axes.motors[k], axis.motor.upper + slack);
        EXPECT_GE(set.axes.joints[k], axis.joint.lower - slack);
        EXPECT_LE(set.axes.joints[k], axis.joint.upper + slack);
        EXPECT_LE(std::abs(set.motor_increment[k]), axis.max_motor_speed * 0.002 + slack);
      }
      ++reading.step;
    } while (!driver.at_boundary());
  }

  std::unique_ptr<irb6::Arm> arm;
  AxisVector joints;  ///< at the start
  AxisVector start;   ///< motors at the start
  HardwareReading reading;
  EffectorCommand command;
  double acceleration{};
  double worst_acceleration{};  ///< of the set motor positions [rad per step squared]
};

TEST_P(Irb6Driver, StopsBeforeEveryLimitAndSingularityWithoutAJerk) {
  std::mt19937_64 random(1);
  int ended = 0;
  for (int run = 0; run < 200; ++run) {
    Driver driver = synchronised();
    const Vector3 v = uniform(random, 0, 0.4) * random_direction(random);
    const Vector3 w = run % 3 ? Vector3(uniform(random, 0, 1.5) * random_direction(random)) : Vector3::Zero();
    command.arm.frame = {u(v.x()), u(v.y()), u(v.z()), u(w.x()), u(w.y()), u(w.z())};
    for (int k = 0; k < 500 && driver.reply().verdict == Verdict::executed && !driver.fault(); ++k) {
      macrostep(driver, true);
      if (k == 0) worst_acceleration = 0;  // the start of a velocity is a step, as it is commanded
    }
    ended += driver.fault() || driver.reply().verdict != Verdict::executed;
    for (int k = 0; k < 5; ++k) macrostep(driver, false);
    EXPECT_EQ(driver.state(), DriverState::holding);
    EXPECT_LT(worst_acceleration, 0.05) << run;
  }
  EXPECT_GT(ended, 190) << "nearly every straight way or screw leads to a limit";
}

TEST_P(Irb6Driver, ReachesPosesInTheTaskFrameAndThroughTheMotors) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 100; ++run) {
    Driver driver = synchronised();
    const Pose here = driver.set_point().T_0E;
    const Pose target =
        here * Pose{rotation_from_angle_axis(uniform(random, 0, 0.3) * random_direction(random)),
                    uniform(random, 0, 0.1) * random_direction(random)};
    command.arm.mu = run % 2 ? Interpolation::mim : Interpolation::tcim_pose;
    command.arm.representation = Representation::frame;
    command.arm.pose = numbers_from_pose(Representation::frame, target);
    command.arm.n_s = command.arm.n_Q = 1000;
    macrostep(driver, true);
    ASSERT_EQ(driver.reply().verdict, Verdict::executed) << describe(driver.reply().fault);
    for (int k = 0; k < 10; ++k) macrostep(driver, false);
    EXPECT_LT(distance(driver.set_point().T_0E, target), 1e-9);
    const AxisVector& q = driver.set_point().axes.joints;
    EXPECT_LT(distance(arm->forward(q) * parameters().T_WE, target), 1e-9);
  }
}

TEST_P(Irb6Driver, SetPointsStayWithinTheLimitsOfSpeedAndAccelerationWhateverIsCommanded) {
  DriverParameters p = parameters();
  p.limits = {};
#ifdef MRROC_SANITIZED
  const test::SetPointCount count = test::count_set_points(*arm, p, 20'000, 4);
#else
  const test::SetPointCount count = test::count_set_points(*arm, p, 500'000, 4);
#endif
  EXPECT_EQ(count.violations, 0);
  EXPECT_GT(count.moving, count.steps / 3);
  EXPECT_GT(count.speed, 0.5) << "the limits must have been near";
  EXPECT_GT(count.acceleration, 0.5);
#ifdef MRROC_SANITIZED
  constexpr double kNear = 0.5;  // fewer steps come less near
#else
  constexpr double kNear = 0.9;
#endif
  EXPECT_GT(count.tip_speed, kNear);
  EXPECT_GT(count.tip_acceleration, kNear);
}

INSTANTIATE_TEST_SUITE_P(BothArms, Irb6Driver, testing::Values("irb6_postument", "irb6_track"));

}  // namespace
}  // namespace mrroc::edp
