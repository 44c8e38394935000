// Execution of motion commands by a driver.
#include <gtest/gtest.h>

#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {
namespace {

using mrroc::test::distance;

ArmCommand pose_command(Interpolation mu, Representation r, const PoseNumbers& pose, int n_s,
                        Reference reference = Reference::absolute) {
  ArmCommand a;
  a.mu = mu;
  a.representation = r;
  a.reference = reference;
  a.pose = pose;
  a.n_s = static_cast<std::uint16_t>(n_s);
  a.n_Q = static_cast<std::uint16_t>(n_s);
  return a;
}

TEST(DriverMotion, ApproachInGuardedModeSettlesAtVelocityOverMobility) {
  Rig rig;
  ASSERT_EQ(rig.synchronise().verdict, Verdict::executed);
  rig.world.stiffness[2] = 5000;
  rig.world.one_sided = true;
  rig.world.T_0E_free.p.z() += 0.005;
  const EffectorReply reply = rig.repeat(rig.velocity({u(), u(), g(0.01, 5, 0.0025), u(), u(), u()}), 200);
  EXPECT_EQ(reply.verdict, Verdict::executed);
  EXPECT_NEAR(reply.F_a[Axis::z], 4, 0.02);
  EXPECT_NEAR(rig.world.T_0E().p.z() - rig.world.T_0E_free.p.z(), 4. / 5000, 1e-5);
}

TEST(DriverMotion, ContactSettlesAtTheDesiredForceAlongAndAboutEveryAxis) {
  for (const Axis axis : kAxes)
    for (const double sign : {1.0, -1.0}) {
      Rig rig;
      rig.synchronise();
      const bool rotational = axis >= Axis::ax;
      rig.world.stiffness[static_cast<int>(axis)] = rotational ? 100 : 2000;
      TaskFrameCommand frame{};
      frame[axis] = rotational ? c(sign * 1.5, 0.5, 0.05) : c(sign * 6, 20, 0.005);
      const EffectorReply reply = rig.repeat(rig.velocity(frame), 300);
      EXPECT_NEAR(reply.F_a[axis], sign * (rotational ? 1.5 : 6), 0.02);
      for (const Axis other : kAxes) {  // it acts at E: there it has no moment
        if (other == axis) continue;
        EXPECT_NEAR(reply.F_a[other], 0, 0.1) << static_cast<int>(other);
      }
    }
}

TEST(DriverMotion, UnguardedMotionIgnoresTheForce) {
  Rig free, pushed;
  for (Rig* rig : {&free, &pushed}) rig->synchronise();
  pushed.world.stiffness.head<3>().setConstant(300);
  pushed.world.stiffness.tail<3>().setConstant(5);
  std::mt19937_64 random(1);
  for (int k = 0; k < 50; ++k) {
    TaskFrameCommand frame{};
    for (const Axis a : kAxes) frame[a] = u(uniform(random, -0.1, 0.1));
    for (Rig* rig : {&free, &pushed}) rig->macrostep(rig->velocity(frame));
    ASSERT_EQ(free.driver.set_point().T_0E.p, pushed.driver.set_point().T_0E.p);
    ASSERT_EQ(free.driver.set_point().T_0E.R, pushed.driver.set_point().T_0E.R);
  }
  EXPECT_GT(std::abs(pushed.driver.reply().F_a[Axis::x]), 0.1) << "there must have been a force to ignore";
}

TEST(DriverMotion, VelocityIsMeantInTheMovingTaskFrame) {
  // Forward and turning at once: a circle.
  Rig rig;
  rig.synchronise();
  const Pose start = rig.driver.set_point().T_0E;
  rig.repeat(rig.velocity({u(0.05), u(), u(), u(), u(), u(0.5)}, 20), 50);  // 2 s
  const Pose T = start.inverse() * rig.driver.set_point().T_0E;
  EXPECT_NEAR(T.p.x(), 0.1 * std::sin(1.0), 2e-4);
  EXPECT_NEAR(T.p.y(), 0.1 * (1 - std::cos(1.0)), 2e-4);
  EXPECT_NEAR(angle_axis_from_rotation(T.R).z(), 1, 1e-12);
}

TEST(DriverMotion, TcimPoseReachesItsPoseInEachOfItsRepresentations) {
  std::mt19937_64 random(2);
  for (const Representation r :
       {Representation::frame, Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    Rig rig;
    rig.synchronise();
    for (int k = 0; k < 30; ++k) {
      const bool relative = pick(random, 2) == 0;
      const Pose now = rig.driver.set_point().T_0E;
      const Pose target{rotation_from_angle_axis(random_vector(random, 0.5)), random_vector(random, 0.3)};
      const Pose given = relative ? now.inverse() * target : target;
      const EffectorReply reply = rig.macrostep(
          rig.set_arm(pose_command(Interpolation::tcim_pose, r, numbers_from_pose(r, given), 1000,
                                   relative ? Reference::relative : Reference::absolute)));
      ASSERT_EQ(reply.verdict, Verdict::executed) << to_string(reply.fault.code);
      rig.silence(10);
      ASSERT_LT(distance(rig.driver.set_point().T_0E, target), 1e-9);
      ASSERT_LT(distance(rig.world.T_0E(), target), 1e-4);
    }
  }
}

TEST(DriverMotion, TcimPoseGoesStraight) {
  Rig rig;
  rig.synchronise();
  const Pose start = rig.driver.set_point().T_0E;
  const Vector3 way(0.1, -0.2, 0.05);
  const Pose target{rotation_from_angle_axis({0, 0, 1.2}), start.p + way};
  rig.after_each_step = [&] {
    const Vector3 done = rig.driver.set_point().T_0E.p - start.p;
    EXPECT_LT(done.cross(way.normalized()).norm(), 1e-9);
  };
  rig.macrostep(rig.set_arm(pose_command(Interpolation::tcim_pose, Representation::frame,
                                         numbers_from_pose(Representation::frame, target), 500)));
}

TEST(DriverMotion, MimReachesItsPoseInEachOfTheFiveRepresentations) {
  std::mt19937_64 random(3);
  for (int kind = 0; kind < 5; ++kind) {
    const auto r = static_cast<Representation>(kind);
    Rig rig;
    rig.synchronise();
    for (int k = 0; k < 30; ++k) {
      const bool relative = pick(random, 2) == 0;
      const SetPoint& now = rig.driver.set_point();
      AxisVector joints(FakeArm::kAxes);
      joints << random_vector(random, 0.3), random_vector(random, 1);
      const Pose target = rig.arm.forward(joints) * Rig::parameters().T_WE;
      PoseNumbers given{};
      if (r == Representation::motors) {
        AxisVector motors = rig.arm.motors_from_joints(joints);
        if (relative) motors -= now.axes.motors;
        given = numbers_from_axes(motors);
      } else if (r == Representation::joints) {
        if (relative) joints -= now.axes.joints;
        given = numbers_from_axes(joints);
      } else {
        given = numbers_from_pose(r, relative ? now.T_0E.inverse() * target : target);
      }
      const EffectorReply reply = rig.macrostep(rig.set_arm(pose_command(
          Interpolation::mim, r, given, 1000, relative ? Reference::relative : Reference::absolute)));
      ASSERT_EQ(reply.verdict, Verdict::executed) << to_string(reply.fault.code);
      rig.silence(10);
      ASSERT_LT(distance(rig.driver.set_point().T_0E, target), 1e-9);
      ASSERT_LT(distance(rig.world.T_0E(), target), 1e-4);
    }
  }
}

TEST(DriverMotion, MimMovesEveryMotorEvenly) {
  Rig rig;
  rig.synchronise();
  const AxisVector start = rig.driver.set_point().axes.motors;
  const PoseNumbers way{-10, 5, 7, 3, -2, 9};
  int k = 0;
  rig.after_each_step = [&] {
    ++k;
    const AxisVector expected = start + axes_from_numbers(way, FakeArm::kAxes) * (k / 1000.);
    EXPECT_LT((rig.driver.set_point().axes.motors - expected).cwiseAbs().maxCoeff(), 1e-9);
  };
  rig.macrostep(
      rig.set_arm(pose_command(Interpolation::mim, Representation::motors, way, 1000, Reference::relative)));
}

TEST(DriverMotion, RelativePosesBeginAtTheSetPoseSoThatLagDoesNotAddUp) {
  Rig rig;
  rig.synchronise();
  const Pose start = rig.driver.set_point().T_0E;
  ArmCommand a = pose_command(Interpolation::tcim_pose, Representation::xyz_angle_axis, {0.002}, 10,
                              Reference::relative);
  rig.repeat(rig.set_arm(a), 100);
  EXPECT_NEAR((rig.driver.set_point().T_0E.p - start.p).x(), 0.2, 1e-12);
}

TEST(DriverMotion, MacrostepLastsItsStepsAndReplyComesInStepNQ) {
  std::mt19937_64 random(4);
  Rig rig;
  rig.synchronise();
  for (int run = 0; run < 500; ++run) {
    ArmCommand a;
    a.n_s = static_cast<std::uint16_t>(1 + pick(random, 20));
    a.n_Q = static_cast<std::uint16_t>(1 + pick(random, a.n_s + 1));
    a.frame.y = u(run % 2 ? 0.01 : -0.01);
    const double before = rig.driver.set_point().T_0E.p.y();
    rig.driver.take(rig.set_arm(a));
    int steps = 0;
    int replied = 0;
    do {
      rig.step();
      ++steps;
      if (rig.driver.reply_due()) {
        EXPECT_EQ(replied, 0) << "one reply per macrostep";
        replied = steps;
        EXPECT_EQ(rig.driver.reply().number, rig.number);
      }
    } while (!rig.driver.at_boundary());
    EXPECT_EQ(steps, std::max(a.n_s, a.n_Q));
    EXPECT_EQ(replied, a.n_Q);
    // The passive step of n_Q = n_s + 1 does not move the set point.
    EXPECT_NEAR(rig.driver.set_point().T_0E.p.y() - before, a.frame.y.velocity * 0.002 * a.n_s, 1e-12);
  }
}

TEST(DriverMotion, ReplyCarriesTheMeasuredOrTheSetPoseInEveryRepresentation) {
  Rig rig;
  rig.synchronise();
  for (int kind = 0; kind < 5; ++kind)
    for (const Feedback feedback : {Feedback::measured, Feedback::set_value}) {
      EffectorCommand c = rig.velocity({u(0.02), u(), u(), u(), u(0.1), u()});
      c.instruction = Instruction::set_get;
      c.get = Part::arm | Part{};
      c.get_representation = static_cast<Representation>(kind);
      c.feedback = feedback;
      rig.driver.take(c);
      AxisPositions at;
      Pose T_0E;
      do {
        // What is measured belongs to the beginning of the step, what is set to the step itself.
        at.motors = rig.world.motors();
        rig.step();
        if (feedback == Feedback::set_value) at.motors = rig.driver.set_point().axes.motors;
        at.joints = rig.arm.joints_from_motors(at.motors);
        T_0E = rig.arm.forward(at.joints) * Rig::parameters().T_WE;
      } while (!rig.driver.reply_due());
      const EffectorReply& reply = rig.driver.reply();
      EXPECT_EQ(reply.representation, c.get_representation);
      const double tolerance = feedback == Feedback::set_value ? 1e-9 : 2e-3;  // an increment of the encoder
      if (c.get_representation == Representation::motors) {
        EXPECT_LT((axes_from_numbers(reply.pose, 6) - at.motors).cwiseAbs().maxCoeff(), tolerance);
      } else if (c.get_representation == Representation::joints) {
        EXPECT_LT((axes_from_numbers(reply.pose, 6) - at.joints).cwiseAbs().maxCoeff(), tolerance);
      } else {
        const std::optional<Pose> T = pose_from_numbers(c.get_representation, reply.pose);
        ASSERT_TRUE(T);
        EXPECT_LT(distance(*T, T_0E), tolerance);
      }
      while (!rig.driver.at_boundary()) rig.step();
    }
}

TEST(DriverMotion, SetValueOfAReplyIsThatOfItsStep) {
  for (const int n_Q : {1, 4, 10, 11}) {
    Rig rig;
    rig.synchronise();
    EffectorCommand c = rig.velocity({u(), u(0.05), u(), u(), u(), u()});
    c.instruction = Instruction::set_get;
    c.get = Part::arm | Part{};
    c.get_representation = Representation::xyz_angle_axis;
    c.feedback = Feedback::set_value;
    c.arm.n_Q = static_cast<std::uint16_t>(n_Q);
    const double start = rig.driver.set_point().T_0E.p.y();
    EXPECT_NEAR(rig.macrostep(c).pose[1] - start, 1e-4 * std::min(n_Q, 10), 1e-12);
  }
}

TEST(DriverMotion, SamplesAreTheReadingsOfAllStepsSinceTheReplyBefore) {
  Rig rig;
  rig.synchronise();
  const TaskFrameCommand forward{u(0.05), u(), u(), u(), u(), u()};
  int replies = 0;
  double last = 0;
  rig.after_each_step = [&] {
    if (!rig.driver.reply_due()) return;
    const auto samples = rig.driver.samples();
    EXPECT_EQ(samples.back().sample().T_0E, rig.driver.reply().T_0E);
    EXPECT_EQ(samples.back().F_a, rig.driver.reply().F_a);
    if (++replies > 2) {  // by now the arm moves steadily
      EXPECT_EQ(samples.size(), 10u);
      for (const MeasuredStep& sample : samples) {
        EXPECT_NEAR(sample.T_0E.p.x() - last, 1e-4, 1e-5) << "0.1 mm per step, to the encoder's resolution";
        last = sample.T_0E.p.x();
      }
    }
    last = samples.back().T_0E.p.x();
  };
  rig.repeat(rig.velocity(forward), 8);
  rig.after_each_step = nullptr;
  rig.driver.take(rig.velocity(forward, 100));
  do rig.step();
  while (!rig.driver.reply_due());
  EXPECT_EQ(rig.driver.samples().size(), 100u) << "a long macrostep loses none";
  EXPECT_EQ(rig.driver.samples().back().sample().T_0E, rig.driver.reply().T_0E);
  for (std::size_t k = 1; k < rig.driver.samples().size(); ++k)
    EXPECT_NEAR(rig.driver.samples()[k].T_0E.p.x() - rig.driver.samples()[k - 1].T_0E.p.x(), 1e-4, 1e-5);
}

TEST(DriverMotion, LawRemembersTheVelocityOfTheWristInTheBase) {
  // With a large inertia and no force a contact axis coasts: while E turns, the wrist must go on straight.
  DriverParameters p = Rig::parameters();
  p.T_WE = {};
  Rig rig(p);
  rig.synchronise();
  const TaskFrameCommand coast{c(0, 1000, 1), c(0, 1000, 1), c(0, 1000, 1), u(), u(), u(1)};
  rig.macrostep(rig.velocity({u(0.04), u(), u(), u(), u(), u(1)}));
  const Vector3 direction = rig.driver.set_point().v_0W.linear();
  const Vector3 start = rig.driver.set_point().T_0E.p;
  rig.repeat(rig.velocity(coast), 50);  // 1 s: E has turned by 1 rad
  const Vector3 way = rig.driver.set_point().T_0E.p - start;
  EXPECT_LT(way.cross(direction.normalized()).norm(), 2e-4);
  EXPECT_NEAR(way.norm(), 0.04, 2e-4);
}

TEST(DriverMotion, LawBeginsAtRestAfterAMotorMotionThatEndedWithItsPassiveStep) {
  Rig rig;
  rig.synchronise();
  ArmCommand a =
      pose_command(Interpolation::mim, Representation::motors, {0, 0, 0, 2}, 20, Reference::relative);
  rig.macrostep(rig.set_arm(a));
  a.n_Q = 21;
  rig.macrostep(rig.set_arm(a));
  const Pose before = rig.driver.set_point().T_0E;
  TaskFrameCommand frame{};
  for (const Axis axis : kAxes) frame[axis] = c(0, 20, 0.005);
  rig.macrostep(rig.velocity(frame));
  EXPECT_LT(distance(rig.driver.set_point().T_0E, before), 1e-12);
}

TEST(DriverMotion, MotionOfACommandWithANewToolIsThatOfTheNewTool) {
  // Turn about the new E: its origin stays where it is.
  for (const Interpolation mu : {Interpolation::tcim_pose, Interpolation::tcim_velocity}) {
    Rig rig;
    rig.synchronise();
    EffectorCommand c = rig.set_arm(
        pose_command(mu, Representation::xyz_angle_axis, {0, 0, 0, 0, 0.1}, 500, Reference::relative));
    c.arm.frame.ay = u(0.1);
    c.set = Part::arm | Part::robot_model;
    c.robot_model.set_tool = true;
    c.robot_model.tool_representation = Representation::xyz_angle_axis;
    c.robot_model.tool = {0.05, 0.1, 0.3, 0, 0, 1};
    const Pose T_WE = pose_from_angle_axis(Vector6(c.robot_model.tool.data()));
    const Pose start = rig.world.T_0W() * T_WE;
    const Pose end = start * Pose{rotation_from_angle_axis({0, 0.1, 0}), Vector3::Zero()};
    ASSERT_EQ(rig.macrostep(c).verdict, Verdict::executed);
    EXPECT_LT(distance(rig.driver.set_point().T_0E, end), 1e-9);
    EXPECT_LT(distance(rig.arm.forward(rig.driver.set_point().axes.joints) * T_WE, end), 1e-9);
  }
}

TEST(DriverMotion, OrientationStaysARotationOverManySteps) {
  Rig rig;
  rig.synchronise();
  for (int k = 0; k < 50; ++k) {
    const double sign = k % 2 ? 1 : -1;
    rig.macrostep(rig.velocity({u(), u(), u(), u(0.3 * sign), u(0.2 * sign), u(0.4 * sign)}, 1000));
  }
  const Matrix3& R = rig.driver.set_point().T_0E.R;
  EXPECT_LT((R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff(), 2e-15);
}

TEST(DriverMotion, NewToolLeavesTheWristsMotionAsItIs) {
  Rig rig;
  rig.synchronise();
  rig.macrostep(rig.velocity({u(0.04), u(0.02), u(), u(), u(), u(0.3)}));
  const Twist before = rig.driver.set_point().v_0W;
  EffectorCommand c = rig.velocity({});
  for (const Axis a : kAxes) c.arm.frame[a] = mrroc::c(0, 1000, 1);
  c.set = Part::arm | Part::robot_model;
  c.robot_model.set_tool = true;
  c.robot_model.tool_representation = Representation::xyz_angle_axis;
  c.robot_model.tool = {0.1, -0.1, 0.2, 1, 0.5, -2};
  const EffectorReply reply = rig.macrostep(c);
  ASSERT_EQ(reply.verdict, Verdict::executed);
  EXPECT_LT(distance(rig.driver.set_point().v_0W, before), 1e-4);
  const Pose T_WE = pose_from_angle_axis(Vector6(c.robot_model.tool.data()));
  EXPECT_LT(distance(rig.driver.set_point().T_0E * T_WE.inverse(),
                     rig.arm.forward(rig.driver.set_point().axes.joints)),
            1e-9);
}

}  // namespace
}  // namespace mrroc::edp::test
