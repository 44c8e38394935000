// Parameters that a driver accepts, and their effect at its start.
#include "edp/driver_parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

using Change = void (*)(DriverParameters&);

/// @return what the driver says of changed parameters, "accepted" when nothing
std::string error_text(Change change) {
  const FakeArm arm;
  DriverParameters p = Rig::parameters();
  change(p);
  try {
    const Driver driver(arm, p);
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    return e.what();
  }
  return "accepted";
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(DriverParameters, SenselessOnesAreRefusedByName) {
  struct Case {
    const char* name;
    Change change;
  };
  const std::vector<Case> cases{
      {"dt", [](DriverParameters& p) { p.dt = 0; }},
      {"dt", [](DriverParameters& p) { p.dt = -0.002; }},
      {"dt", [](DriverParameters& p) { p.dt = 0.1001; }},
      {"n_s", [](DriverParameters& p) { p.n_s = 0; }},
      {"n_s", [](DriverParameters& p) { p.n_s = kMaxSteps + 1; }},
      {"stop_steps", [](DriverParameters& p) { p.stop_steps = 0; }},
      {"stop_steps", [](DriverParameters& p) { p.stop_steps = kMaxStopSteps + 1; }},
      {"synchro_joints", [](DriverParameters& p) { p.synchro_joints.resize(3); }},
      {"synchro_joints", [](DriverParameters& p) { p.synchro_joints[5] = kNan; }},
      {"begin with an axis", [](DriverParameters& p) { p.homing.first_axis = -1; }},
      {"begin with an axis", [](DriverParameters& p) { p.homing.first_axis = FakeArm::kAxes; }},
      {"steps of homing", [](DriverParameters& p) { p.homing.ramp_steps = 0; }},
      {"steps of homing", [](DriverParameters& p) { p.homing.standstill_steps = -1; }},
      {"steps of homing", [](DriverParameters& p) { p.homing.settle_steps = -1; }},
      {"speeds of homing", [](DriverParameters& p) { p.homing.axis.front().coarse = 0; }},
      {"speeds of homing", [](DriverParameters& p) { p.homing.axis[3].fine = 0; }},
      {"speeds of homing", [](DriverParameters& p) { p.homing.axis[3].fine = -1; }},
      {"tool", [](DriverParameters& p) { p.T_WE.R *= 2; }},
      {"sensor's place", [](DriverParameters& p) { p.force.T_WS.R *= 2; }},
      {"average", [](DriverParameters& p) { p.force.average = 0; }},
      {"average", [](DriverParameters& p) { p.force.average = 5; }},
      {"low pass", [](DriverParameters& p) { p.force.low_pass = -1; }},
      {"servo",
       [](DriverParameters& p) {
         p.servo = ServoChoice{kServoAlgorithms, 0};
       }},
      {"servo",
       [](DriverParameters& p) {
         p.servo = ServoChoice{0, kServoSets};
       }},
      {"bad forces", [](DriverParameters& p) { p.force.fault_after = 0; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.force = 0; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.torque = 0; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.growth = 0.99; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.sustained = 0; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.periods = 1; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.periods = kMostPeriods + 1; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.lowest = 0; }},
      {"unstable contact", [](DriverParameters& p) { p.oscillation.highest = p.oscillation.lowest; }},
      {"full torque", [](DriverParameters& p) { p.supervision.torque_steps = 0; }},
      {"equal forces", [](DriverParameters& p) { p.force.stuck_after = -1; }},
  };
  for (std::size_t k = 0; k < cases.size(); ++k)
    EXPECT_NE(error_text(cases[k].change).find(cases[k].name), std::string::npos)
        << k << ' ' << cases[k].name << ": " << error_text(cases[k].change);
}

TEST(DriverParameters, HomingStandsHalfASecondOnTheSwitchUnlessToldOtherwise) {
  const DriverParameters p;
  EXPECT_NEAR(p.homing.standstill_steps * p.dt, 0.5, 1e-12);
  EXPECT_NEAR(p.homing.settle_steps * p.dt, 0.05, 1e-12);
  EXPECT_NEAR(p.homing.ramp_steps * p.dt, 0.02, 1e-12);
}

TEST(DriverParameters, HomingLooksForTheSwitchAndLeavesItAsFastAsTheOriginalUnlessToldOtherwise) {
  const DriverParameters p;
  EXPECT_EQ(p.homing.first_axis, 0);
  EXPECT_FALSE(p.homing.returns);
  for (const AxisHoming& axis : p.homing.axis) {
    EXPECT_NEAR(axis.coarse * p.dt, 0.03, 1e-12) << "radians in a step";
    EXPECT_NEAR(axis.fine * p.dt, 0.007, 1e-12);
    EXPECT_EQ(axis.position, 0) << "it counts from the mark";
  }
}

TEST(DriverParameters, UnlessToldOtherwiseTheWristIsThatOfTheIrb6) {
  const DriverParameters p;
  EXPECT_EQ(p.force.range, (Wrench{{65, 65, 200, 5, 5, 5}})) << "of its sensor";
  EXPECT_EQ(p.limits.force, (Wrench{{65, 65, 130, 5, 5, 5}})) << "what it may be told to exert";
  for (const Axis a : kAxes) {
    EXPECT_LE(p.limits.contact_force[a], 0.9 * p.force.range[a]);
    EXPECT_GT(p.limits.contact_force[a], 0.88 * std::min(p.limits.force[a], p.force.range[a]));
  }
  EXPECT_EQ(p.limits.linear_acceleration * p.dt, 0.2) << "of E, a step of the papers' tables";
  EXPECT_EQ(p.limits.angular_acceleration * p.dt, 1);
  EXPECT_EQ(p.limits.motor_acceleration * p.dt, 100) << "from rest";
  EXPECT_EQ(p.limits.linear_velocity, 0.5);
  EXPECT_EQ(p.limits.angular_velocity, 2);
  EXPECT_EQ(p.limits.inertia, 1000);
  EXPECT_EQ(p.limits.mobility, 1);
  EXPECT_EQ(p.limits.weight, 50);
  EXPECT_EQ(p.limits.lever, 1);
  EXPECT_FALSE(p.limits.workspace);
}

TEST(DriverParameters,
     UnlessToldOtherwiseMalfunctionsAreCalledAfterAQuarterMoreAFewReadingsAndFiftyMilliseconds) {
  const DriverParameters p;
  EXPECT_EQ(p.supervision.over_speed, 1.25);
  EXPECT_EQ(p.supervision.following_error, 1.5);
  EXPECT_NEAR(p.supervision.torque_steps * p.dt, 0.05, 1e-12);
  EXPECT_EQ(p.force.fault_after, 3);
  EXPECT_EQ(p.force.stuck_after, 0) << "never";
  EXPECT_EQ(p.force.average, 1) << "the force is not late";
  EXPECT_EQ(p.force.low_pass, 0);
  EXPECT_EQ(p.start_guard_steps, 0);
  EXPECT_EQ(p.jaws, 0.074);
  EXPECT_FALSE(p.jaws_known);
  EXPECT_FALSE(p.servo) << "the regulators of the robot's table";
  EXPECT_EQ(p.stop_steps, kMaxStopSteps);
  EXPECT_EQ(p.n_s, 10);
}

TEST(DriverParameters, TheirBoundsAreLegal) {
  const std::vector<Change> changes{
      [](DriverParameters&) {},
      [](DriverParameters& p) { p.dt = 0.1; },
      [](DriverParameters& p) { p.n_s = p.stop_steps = 1; },
      [](DriverParameters& p) {
        p.n_s = kMaxSteps;
        p.stop_steps = kMaxStopSteps;
      },
      [](DriverParameters& p) { p.homing.first_axis = FakeArm::kAxes - 1; },
      [](DriverParameters& p) {
        p.homing.ramp_steps = 1;
        p.homing.standstill_steps = p.homing.settle_steps = 0;
      },
      [](DriverParameters& p) { p.force.average = 4; },
      [](DriverParameters& p) { p.force.fault_after = 1; },
      [](DriverParameters& p) {
        p.servo = ServoChoice{kServoAlgorithms - 1, kServoSets - 1};
      },
      [](DriverParameters& p) { p.oscillation.growth = 1; },
      [](DriverParameters& p) { p.oscillation.periods = 2; },
      [](DriverParameters& p) { p.oscillation.periods = kMostPeriods; },
      [](DriverParameters& p) { p.supervision.torque_steps = 1; },
      [](DriverParameters& p) {  // an arm that is homed needs no known pose
        p.synchronisation = Synchronisation::homing;
        p.synchro_joints.resize(0);
      },
  };
  for (std::size_t k = 0; k < changes.size(); ++k) EXPECT_EQ(error_text(changes[k]), "accepted") << k;
}

TEST(DriverParameters, ToolLoadAndRegulatorsAreThoseOfTheParametersUntilTheyAreSet) {
  DriverParameters p = Rig::parameters();
  p.force.weight = 6;
  p.force.mass_centre = Vector3(0.01, -0.02, 0.03);
  p.servo = ServoChoice{1, 1};
  Rig rig(p);
  const RobotModel told = rig.silence(1).robot_model;
  EXPECT_EQ(told.weight, 6);
  EXPECT_EQ(told.mass_centre, (std::array{0.01, -0.02, 0.03}));
  for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
    EXPECT_EQ(told.servo_algorithm[k], 1) << k;
    EXPECT_EQ(told.servo_parameter_set[k], 1) << k;
  }
  EXPECT_TRUE(told.set_tool && told.set_force_tool && told.set_kinematic_model) << "all of it is told";
}

TEST(DriverParameters, AMacrostepWithoutACommandLastsTheirStepsAndRepliesInTheLastButOne) {
  for (const int n_s : {1, 2, 7}) {
    DriverParameters p = Rig::parameters();
    p.n_s = n_s;
    Rig rig(p);
    for (int macrostep = 0; macrostep < 3; ++macrostep) {
      int steps = 0, replied = 0;
      do {
        rig.step();
        ++steps;
        if (rig.driver.reply_due()) replied = steps;
      } while (!rig.driver.at_boundary());
      EXPECT_EQ(steps, n_s);
      EXPECT_EQ(replied, n_s == 1 ? 1 : n_s - 1);
    }
  }
}

/// A robot of any number of axes, each with a gear of one.
class Straight final : public Robot {
 public:
  explicit Straight(int axes) : axes_(axes) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "straight"; }
  [[nodiscard]] int axes() const noexcept override { return axes_; }
  [[nodiscard]] const AxisProperties& axis(int) const noexcept override { return axis_; }
  [[nodiscard]] Pose forward(const AxisVector& q) const noexcept override {
    return {Matrix3::Identity(), q.head<3>()};
  }
  [[nodiscard]] InverseSolution inverse(const Pose&, const AxisVector& near) const noexcept override {
    return {.joints = near, .reached = true};
  }
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& q) const noexcept override { return 2 * q; }
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& m) const noexcept override { return m / 2; }

 private:
  int axes_;
  AxisProperties axis_{.name = "any",
                       .joint = {-1, 1},
                       .motor = {-2, 2},
                       .increments_per_rad = 100,
                       .max_motor_speed = 10,
                       .servo = {}};
};

TEST(DriverParameters, JawsNeedAMotorBesideThoseOfTheAxes) {
  DriverParameters p = Rig::parameters();
  GripperParameters jaws;
  jaws.distance = jaws.motor = [](double x) noexcept { return x; };
  jaws.legal = {0.05, 0.09};
  jaws.increments_per_rad = jaws.speed = jaws.opening_speed = jaws.acceleration = jaws.homing_speed =
      jaws.max_current = jaws.stiffness = jaws.current_gain = 1;
  jaws.blocked_steps = 1;
  p.gripper = jaws;
  const auto build = [&](int axes) {
    const Straight robot(axes);
    p.synchro_joints = AxisVector::Zero(axes);
    const Driver driver(robot, p);
  };
  EXPECT_NO_THROW(build(kMaxAxes - 1));
  EXPECT_THROW(build(kMaxAxes), FaultError);
}

TEST(Robot, PoseOfMotorsIsThatOfTheirJoints) {
  const Straight robot(4);
  const AxisVector motors = (AxisVector(4) << 2, 4, -6, 8).finished();
  EXPECT_EQ(robot.forward_from_motors(motors).p, Vector3(1, 2, -3));
  EXPECT_EQ(robot.forward_from_motors(motors).R, Matrix3::Identity());
  EXPECT_EQ(robot.gravity(motors), AxisVector::Zero(4)) << "nothing is known of its weight";
  EXPECT_EQ(robot.with_model(0), &robot);
  EXPECT_EQ(robot.with_model(1), nullptr);
  EXPECT_LT((robot.motors_per_joints(motors) - 2 * AxisMatrix::Identity(4, 4)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace mrroc::edp::test
