// Checks of a command's robot model, poses and steps, and of the set points.
#include <gtest/gtest.h>

#include <limits>

#include "base/representation.hpp"
#include "edp/guard.hpp"
#include "test/edp/fake_arm.hpp"

namespace mrroc::edp::test {
namespace {

const Limits kLimits;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ValidationError check(const RobotModel& model) { return check_model(model, FakeArm(), kLimits); }

FaultCode code_of(const ValidationError& wrong) { return wrong ? wrong->code : FaultCode::none; }

TEST(GuardModel, TheWeightLiesBetweenZeroAndItsLimit) {
  RobotModel m;
  m.set_force_tool = true;
  for (const double good : {0., kLimits.weight}) {
    m.weight = good;
    EXPECT_FALSE(check(m)) << good;
  }
  for (const double wrong : {-1e-9, 1.5 * kLimits.weight, kNan}) {
    m.weight = wrong;
    const ValidationError fault = check(m);
    ASSERT_EQ(code_of(fault), FaultCode::out_of_limits) << wrong;
    EXPECT_EQ(fault->limit, kLimits.weight);
    if (wrong == wrong) {
      EXPECT_EQ(fault->value, wrong);
    }
    m.set_force_tool = false;
    EXPECT_FALSE(check(m)) << "nobody sets it";
    m.set_force_tool = true;
  }
}

TEST(GuardModel, ToolAndMassCentreLieWithinTheLeverInEveryDirection) {
  for (std::size_t k = 0; k < 3; ++k)
    for (const double sign : {1., -1.}) {
      RobotModel centre, tool;
      centre.set_force_tool = tool.set_tool = true;
      tool.tool_representation = Representation::xyz_angle_axis;
      centre.mass_centre[k] = tool.tool[k] = sign * kLimits.lever;
      EXPECT_FALSE(check(centre)) << k;
      EXPECT_FALSE(check(tool)) << k;
      centre.mass_centre[k] = tool.tool[k] = sign * 1.5 * kLimits.lever;
      for (const RobotModel& wrong : {centre, tool}) {
        const ValidationError fault = check(wrong);
        ASSERT_EQ(code_of(fault), FaultCode::out_of_limits) << k;
        EXPECT_DOUBLE_EQ(fault->value, 1.5 * kLimits.lever);
        EXPECT_EQ(fault->limit, kLimits.lever);
        EXPECT_EQ(fault->axis, -1);
      }
      centre.mass_centre[k] = kNan;
      EXPECT_TRUE(check(centre));
    }
}

TEST(GuardModel, AToolIsAPoseInARepresentationOfPoses) {
  RobotModel m;
  m.set_tool = true;
  m.tool = numbers_from_pose(Representation::frame, Pose{});
  m.tool_representation = Representation::frame;
  EXPECT_FALSE(check(m));
  m.tool[0] += 0.5;
  EXPECT_EQ(code_of(check(m)), FaultCode::not_a_rotation);
  for (const Representation wrong :
       {Representation::motors, Representation::joints, static_cast<Representation>(5)}) {
    m.tool_representation = wrong;
    const ValidationError fault = check(m);
    ASSERT_EQ(code_of(fault), FaultCode::unknown_enum);
    EXPECT_EQ(fault->value, static_cast<double>(wrong));
  }
}

TEST(GuardModel, RegulatorsAreOfMotorsThatThereAre) {
  RobotModel m;
  m.set_servo_algorithm = (1 << FakeArm::kAxes) - 1;
  EXPECT_FALSE(check(m));
  m.set_servo_algorithm = 1 << FakeArm::kAxes;
  const ValidationError fault = check(m);
  ASSERT_EQ(code_of(fault), FaultCode::out_of_limits);
  EXPECT_EQ(fault->value, 1 << FakeArm::kAxes);
  EXPECT_EQ(fault->limit, (1 << FakeArm::kAxes) - 1);
  m.set_servo_algorithm = 1;
  m.servo_algorithm[0] = 9;
  const ValidationError unknown = check(m);
  ASSERT_EQ(code_of(unknown), FaultCode::unknown_model);
  EXPECT_EQ(unknown->value, 9);
  EXPECT_EQ(unknown->axis, 0) << "of that motor";
  RobotModel kinematic;
  kinematic.set_kinematic_model = true;
  kinematic.kinematic_model = 77;
  const ValidationError none = check(kinematic);
  ASSERT_EQ(code_of(none), FaultCode::unknown_model);
  EXPECT_EQ(none->axis, -1) << "of no axis";
  EXPECT_EQ(none->value, 77);
  EXPECT_EQ(none->limit, 0) << "there is one";
  m.servo_algorithm[0] = static_cast<std::uint8_t>(unknown->limit);
  EXPECT_FALSE(check(m)) << "the last one that there is is told";
  ++m.servo_algorithm[0];
  EXPECT_TRUE(check(m));
}

TEST(GuardArm, EveryNumberOfAPoseThatIsUsedIsFinite) {
  for (const Representation r : {Representation::motors, Representation::joints,
                                 Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    ArmCommand a;
    a.mu = Interpolation::mim;
    a.representation = r;
    for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
      a.pose = {};
      a.pose[k] = kNan;
      const ValidationError fault = check_arm(a, FakeArm::kAxes, kLimits);
      ASSERT_EQ(code_of(fault), FaultCode::not_finite);
      EXPECT_EQ(fault->axis, static_cast<int>(k));
    }
    a.pose = {};
    a.pose[FakeArm::kAxes] = kNan;
    EXPECT_FALSE(check_arm(a, FakeArm::kAxes, kLimits)) << "a number that nobody reads";
  }
}

TEST(GuardArm, WhatIsUnknownOrNoNumberIsRefusedByItsName) {
  const auto refused = [](auto change) {
    ArmCommand a;
    a.mu = Interpolation::tcim_pose;
    a.representation = Representation::xyz_angle_axis;
    change(a);
    return code_of(check_arm(a, FakeArm::kAxes, kLimits));
  };
  EXPECT_EQ(refused([](ArmCommand&) {}), FaultCode::none);
  EXPECT_EQ(refused([](ArmCommand& a) { a.mu = static_cast<Interpolation>(3); }), FaultCode::unknown_enum);
  EXPECT_EQ(refused([](ArmCommand& a) { a.reference = static_cast<Reference>(2); }), FaultCode::unknown_enum);
  EXPECT_EQ(refused([](ArmCommand& a) { a.representation = static_cast<Representation>(5); }),
            FaultCode::unknown_enum);
  for (const Representation of_axes : {Representation::motors, Representation::joints}) {
    ArmCommand a;
    a.mu = Interpolation::tcim_pose;
    a.representation = of_axes;
    EXPECT_EQ(code_of(check_arm(a, FakeArm::kAxes, kLimits)), FaultCode::unknown_enum) << "no pose of E";
    a.mu = Interpolation::mim;
    EXPECT_FALSE(check_arm(a, FakeArm::kAxes, kLimits));
  }
  EXPECT_EQ(refused([](ArmCommand& a) { a.gripper = kNan; }), FaultCode::not_finite);
  EXPECT_EQ(refused([](ArmCommand& a) {
              a.representation = Representation::frame;
              a.pose = {};
            }),
            FaultCode::not_a_rotation);
  EXPECT_EQ(refused([](ArmCommand& a) { a.frame.ay.force = kNan; }), FaultCode::not_finite);
  EXPECT_EQ(refused([](ArmCommand& a) { a.frame.ay.velocity = 1e9; }), FaultCode::none)
      << "TCIM-POSE computes its velocities";
}

TEST(GuardForm, InstructionsPartsAndRepresentationsAreKnownOnes) {
  const auto form = [](Instruction instruction, auto change) {
    EffectorCommand c;
    c.instruction = instruction;
    change(c);
    return code_of(check_form(c));
  };
  const auto nothing = [](EffectorCommand&) {};
  EXPECT_EQ(form(Instruction::release, nothing), FaultCode::none);
  EXPECT_EQ(form(static_cast<Instruction>(static_cast<int>(Instruction::release) + 1), nothing),
            FaultCode::unknown_enum);
  const auto all = static_cast<std::uint8_t>(~0U);
  const auto sets_all = [&](EffectorCommand& c) { c.set = all; };
  const auto gets_all = [&](EffectorCommand& c) { c.get = all; };
  const auto gets_bias = [](EffectorCommand& c) { c.get = static_cast<std::uint8_t>(Part::force_bias); };
  const auto sets_bias = [](EffectorCommand& c) { c.set = static_cast<std::uint8_t>(Part::force_bias); };
  for (const Instruction set : {Instruction::set, Instruction::set_get}) {
    EXPECT_EQ(form(set, sets_all), FaultCode::unknown_enum);
    EXPECT_EQ(form(set, sets_bias), FaultCode::none);
  }
  EXPECT_EQ(form(Instruction::get, sets_all), FaultCode::none) << "GET sets nothing";
  for (const Instruction get : {Instruction::get, Instruction::set_get}) {
    EXPECT_EQ(form(get, gets_all), FaultCode::unknown_enum);
    EXPECT_EQ(form(get, gets_bias), FaultCode::unknown_enum) << "a bias cannot be asked for";
    const auto tool = [](Representation r, Part part) {
      return [=](EffectorCommand& c) {
        c.get = static_cast<std::uint8_t>(part);
        c.get_tool_representation = r;
      };
    };
    for (const Representation r :
         {Representation::motors, Representation::joints, static_cast<Representation>(5)}) {
      EXPECT_EQ(form(get, tool(r, Part::robot_model)), FaultCode::unknown_enum);
      EXPECT_EQ(form(get, tool(r, Part::arm)), FaultCode::none) << "nobody asks for the tool";
    }
    EXPECT_EQ(form(get, tool(Representation::xyz_angle_axis, Part::robot_model)), FaultCode::none);
    EXPECT_EQ(form(get, [](EffectorCommand& c) { c.get_representation = static_cast<Representation>(5); }),
              FaultCode::unknown_enum);
    EXPECT_EQ(form(get, [](EffectorCommand& c) { c.feedback = static_cast<Feedback>(2); }),
              FaultCode::unknown_enum);
  }
  EXPECT_EQ(form(Instruction::set, gets_all), FaultCode::none) << "SET asks for nothing";
}

TEST(GuardRanges, AreThoseOfEveryMotorAndJointWithTheirBounds) {
  const FakeArm arm;
  const AxisRanges ranges(arm, 0.002, 1000);
  const AxisVector zero = AxisVector::Zero(FakeArm::kAxes);
  for (int k = 0; k < FakeArm::kAxes; ++k)
    for (const bool upper : {true, false}) {
      const AxisProperties& axis = arm.axis(k);
      for (const bool motor : {true, false}) {
        const Range& legal = motor ? axis.motor : axis.joint;
        AxisPositions at{zero, zero};
        double& x = (motor ? at.motors : at.joints)[k];
        x = upper ? legal.upper : legal.lower;
        EXPECT_TRUE(ranges.contain(at)) << k;
        x *= 1.0001;
        EXPECT_FALSE(ranges.contain(at)) << k;
        x = kNan;
        EXPECT_FALSE(ranges.contain(at)) << k;
      }
      const double sign = upper ? 1 : -1;
      const double most = axis.max_motor_speed * 0.002, change = 1000 * 0.002 * 0.002;
      AxisVector before = zero, after = zero;
      before[k] = after[k] = sign * most;
      EXPECT_TRUE(ranges.allow(before, after)) << k;
      after[k] = sign * most * 1.0001;
      EXPECT_FALSE(ranges.allow(before, after)) << k << " too fast";
      after[k] = before[k] - sign * 0.99 * change;
      EXPECT_TRUE(ranges.allow(before, after)) << k;
      after[k] = before[k] - sign * 1.01 * change;
      EXPECT_FALSE(ranges.allow(before, after)) << k << " too hard";
    }
}

TEST(GuardWorkspace, ItsSidesBelongToIt) {
  Limits limits;
  limits.workspace = Box{{-0.1, -0.2, 0.3}, {0.1, 0.2, 0.5}};
  Pose from;
  from.p = Vector3(0, 0, 0.4);
  for (int k = 0; k < 3; ++k)
    for (const bool upper : {true, false}) {
      Pose to = from;
      const double side = upper ? limits.workspace->upper[k] : limits.workspace->lower[k];
      to.p[k] = side;
      EXPECT_FALSE(check_workspace(from, to, limits));
      to.p[k] += upper ? 1e-6 : -1e-6;
      const ValidationError fault = check_workspace(from, to, limits);
      ASSERT_EQ(code_of(fault), FaultCode::outside_workspace);
      EXPECT_EQ(fault->axis, k);
      EXPECT_EQ(fault->value, to.p[k]);
      EXPECT_EQ(fault->limit, side);
      EXPECT_FALSE(check_workspace(from, to, Limits{})) << "there is none";
    }
}

TEST(GuardVelocity, AFaultNamesTheFastestAxisOfItsPart) {
  for (const Axis axis : kAxes) {
    const bool turns = axis >= Axis::ax;
    const double limit = turns ? kLimits.angular_velocity : kLimits.linear_velocity;
    Twist v;
    for (const Axis other : kAxes)
      if ((other >= Axis::ax) == turns) v[other] = 0.1 * limit;
    v[axis] = -2 * limit;
    const ValidationError fault = check_velocity(v, kLimits);
    ASSERT_EQ(code_of(fault), FaultCode::too_fast);
    EXPECT_EQ(fault->axis, static_cast<int>(axis));
    EXPECT_DOUBLE_EQ(fault->value, std::sqrt(4 + 0.02) * limit);
    EXPECT_EQ(fault->limit, limit);
    const ValidationError hard = check_acceleration({}, v, 1e-6, kLimits);
    ASSERT_EQ(code_of(hard), FaultCode::excessive_acceleration);
    EXPECT_EQ(hard->axis, static_cast<int>(axis));
  }
}

}  // namespace
}  // namespace mrroc::edp::test
