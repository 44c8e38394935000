#include "ecp/generators/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/fault.hpp"
#include "base/representation.hpp"
#include "ecp/generators/polynomials.hpp"
#include "ecp/generators/straight_path.hpp"
#include "ecp/generators/trapezoid.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

using std::numbers::pi;

Pose random_pose(RandomList& random) { return pose_from_angle_axis(AngleAxisPose(random.pose(6, 1))); }

TEST(Trajectory, CommandsOfMacrostepsLeadFromSetPositionToSetPosition) {
  RandomList random(1);
  const Coordinates from = random.pose(6, 1);
  const auto curve = std::make_shared<Trapezoid>(from, std::vector<ViaPoint>{{random.pose(6, 1), 0.4, 0.2}},
                                                 default_limits(Representation::joints, 6), 0.02);
  const Trajectory absolute(curve, {});
  const Trajectory relative(curve, {.reference = Reference::relative});
  EXPECT_EQ(absolute.macrosteps(), curve->arrivals().back());
  AxisVector sum = from;
  for (std::int64_t k = 0; k < absolute.macrosteps(); ++k) {
    const ArmCommand command = absolute.command(k);
    EXPECT_EQ(command.mu, Interpolation::mim);
    EXPECT_EQ(command.n_s, 10);
    EXPECT_EQ(command.n_Q, 9);
    EXPECT_EQ(axes_from_numbers(command.pose, 6), absolute.set_position(k + 1));
    sum += axes_from_numbers(relative.command(k).pose, 6);
    EXPECT_NEAR((sum - absolute.set_position(k + 1)).norm(), 0, 1e-12);
  }
  EXPECT_EQ(axes_from_numbers(absolute.command(10'000).pose, 6), curve->at(1e9)) << "stays at its end";
  EXPECT_EQ(axes_from_numbers(relative.command(10'000).pose, 6), AxisVector::Zero(6));
}

TEST(Trajectory, RelativePosesMultiplyToTheAbsoluteOnes) {
  RandomList random(2);
  for (const Representation space : {Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    const Coordinates from = random.pose(6, 1);
    const auto curve = constant_velocity(from, random.pose(6, 1), default_limits(space, 6), 0.1);
    const Trajectory relative(curve, {space, Reference::relative, Interpolation::tcim_pose});
    Pose T = *pose_from_numbers(space, numbers_from_axes(from));
    for (std::int64_t k = 0; k < relative.macrosteps(); ++k)
      T = T * *pose_from_numbers(space, relative.command(k).pose);
    const Pose goal = *pose_from_numbers(space, numbers_from_axes(curve->at(1e9)));
    EXPECT_NEAR((T.p - goal.p).norm(), 0, 1e-9);
    EXPECT_NEAR((T.R - goal.R).norm(), 0, 1e-9);
  }
}

TEST(Trajectory, IsCutIntoMacrostepsOfItsPacing) {
  RandomList random(6);
  const CurvePtr curve = constant_velocity(Coordinates::Zero(6), random.pose(6, 3),
                                           default_limits(Representation::joints, 6), 0.1);
  const Trajectory path(curve, {}, {.dt = 0.004, .n_s = 21, .n_Q = 20});
  EXPECT_EQ(path.macrosteps(), std::ceil(curve->duration() / 0.084));
  for (std::int64_t k = 0; k < path.macrosteps(); ++k) {
    const ArmCommand command = path.command(k);
    EXPECT_EQ(command.n_s, 21);
    EXPECT_EQ(command.n_Q, 20);
    EXPECT_EQ(axes_from_numbers(command.pose, 6), curve->at(0.084 * static_cast<double>(k + 1)));
  }
  EXPECT_EQ(path.set_position(0), Coordinates::Zero(6));
}

TEST(Trajectory, WithoutACurveHasEndedBeforeItBegins) { EXPECT_EQ(Trajectory().macrosteps(), 0); }

TEST(Trajectory, RefusesCodingsThatCannotBeExecuted) {
  const CurvePtr curve = hold(Coordinates::Zero(6), 1);
  const auto make = [&](const Coding& coding, const Pacing& pacing = {}) {
    return Trajectory(curve, coding, pacing);
  };
  EXPECT_THROW(make({.space = Representation::joints, .mu = Interpolation::tcim_pose}), FaultError);
  EXPECT_THROW(make({.space = Representation::frame}), FaultError);
  EXPECT_THROW(make({.mu = Interpolation::tcim_velocity}), FaultError);
  EXPECT_THROW(make({}, {.n_s = 0}), FaultError);
  EXPECT_THROW(make({}, {.n_s = 10, .n_Q = 12}), FaultError);
  EXPECT_THROW(make({}, {.n_s = 10, .n_Q = 0}), FaultError);
  EXPECT_THROW(make({}, {.n_s = kMaxSteps + 1, .n_Q = 1}), FaultError);
  EXPECT_THROW(make({}, {.dt = 0}), FaultError);
  EXPECT_NO_THROW(make({}, {.n_s = 1, .n_Q = 1}));
  EXPECT_NO_THROW(make({}, {.n_s = 10, .n_Q = 11}));
  EXPECT_NO_THROW(make({}, {.n_s = kMaxSteps, .n_Q = 1}));
  EXPECT_THROW(Trajectory(nullptr, {}), FaultError);
}

TEST(Space, NearestCoordinatesAreTheSamePoseAndDoNotJumpAtPi) {
  RandomList random(3);
  for (const Representation space : {Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    const Vector3 axis = Vector3(0.9, 0.1, 0.3).normalized();
    Coordinates before;
    for (double angle = 2; angle < 5; angle += 0.01) {
      const Pose T{rotation_from_angle_axis(angle * axis), Vector3(1, 2, 3)};
      const Coordinates plain = axes_from_numbers(numbers_from_pose(space, T), 6);
      const Coordinates near = before.size() ? nearest_coordinates(space, plain, before) : plain;
      const Pose same = *pose_from_numbers(space, numbers_from_axes(near));
      EXPECT_NEAR((same.R - T.R).norm(), 0, 1e-9);
      if (before.size()) {
        EXPECT_LT((near - before).norm(), 0.06) << "at " << angle;
      }
      before = near;
    }
  }
}

TEST(Space, NearestCoordinatesAreThePoseInTheNumbersThatAreNearToThoseBefore) {
  RandomList random(11);
  for (int k = 0; k < 500; ++k)
    for (const Representation space : {Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
      const Pose T{rotation_from_angle_axis(Vector3(random.pose(3, 1.8))), Vector3(random.pose(3, 1))};
      const Coordinates plain = axes_from_numbers(numbers_from_pose(space, T), 6);
      // Any numbers of the pose, and others near to them.
      Coordinates any = plain;
      if (space == Representation::xyz_euler_zyz) {
        if (random.whole(0, 1) == 1) any.tail<3>() = Vector3(any[3] + pi, -any[4], any[5] - pi);
        for (int a = 3; a < 6; ++a) any[a] += 2 * pi * random.whole(-3, 3);
      } else {
        any.tail<3>() += 2 * pi * random.whole(-3, 3) * Vector3(any.tail<3>()).normalized();
      }
      const Coordinates before = any + random.pose(6, 0.3);
      const Coordinates near = nearest_coordinates(space, plain, before);
      const Pose same = *pose_from_numbers(space, numbers_from_axes(near));
      EXPECT_NEAR((same.R - T.R).norm(), 0, 1e-9) << k;
      EXPECT_LE((near - before).norm(), (any - before).norm() + 1e-9) << k;
    }
}

TEST(Space, LimitsAreTheOriginalsUnlessOthersAreGiven) {
  const MotionLimits motors = default_limits(Representation::motors, 7),
                     joints = default_limits(Representation::joints, 3);
  EXPECT_EQ(motors.velocity, Coordinates(Coordinates::Constant(7, 200)));
  EXPECT_EQ(motors.acceleration, Coordinates(Coordinates::Constant(7, 150)));
  EXPECT_EQ(joints.velocity, Coordinates(Coordinates::Constant(3, 1.5)));
  EXPECT_EQ(joints.acceleration, Coordinates(Coordinates::Constant(3, 7)));
  for (const Representation space : {Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    const MotionLimits pose = default_limits(space, 3);
    Coordinates velocity(6);
    velocity << 0.5, 0.5, 0.5, 2, 2, 2;
    EXPECT_EQ(pose.velocity, velocity);
    EXPECT_EQ(pose.acceleration, Coordinates(Coordinates::Constant(6, 5)));
  }
}

TEST(Space, NearestCoordinatesLeaveMotorsAndJointsAndPositionsAsTheyAre) {
  RandomList random(7);
  for (const Representation space : {Representation::motors, Representation::joints,
                                     Representation::xyz_euler_zyz, Representation::xyz_angle_axis})
    for (int k = 0; k < 50; ++k) {
      const Coordinates pose = random.pose(6, 3), before = random.pose(6, 20);
      const Coordinates near = nearest_coordinates(space, pose, before);
      EXPECT_EQ(near.head<3>(), pose.head<3>());
      if (per_axis(space)) {
        EXPECT_EQ(near, pose);
      } else {
        EXPECT_LE((near - before).tail<3>().norm(), (pose - before).tail<3>().norm() + 1e-12);
      }
    }
}

TEST(Space, NoRotationIsWholeTurnsAboutTheAxisBefore) {
  Coordinates none = Coordinates::Zero(6), before(6);
  before << 1, 2, 3, 0, 0, 6;
  EXPECT_NEAR(
      (nearest_coordinates(Representation::xyz_angle_axis, none, before).tail<3>() - Vector3(0, 0, 2 * pi))
          .norm(),
      0, 1e-12);
  EXPECT_EQ(nearest_coordinates(Representation::xyz_angle_axis, none, none), none);
  before[5] = 3;
  EXPECT_EQ(nearest_coordinates(Representation::xyz_angle_axis, none, before), none);
}

TEST(Space, NothingAddsUpToNothing) { EXPECT_TRUE(accumulated(Representation::joints, {}).empty()); }

TEST(Space, IncrementsAddUpInTheirOwnWay) {
  RandomList random(4);
  const std::vector<Coordinates> increments{random.pose(6, 0.5), random.pose(6, 0.5), random.pose(6, 0.5)};
  const auto joints = accumulated(Representation::joints, increments);
  ASSERT_EQ(joints.size(), 4u);
  EXPECT_NEAR((joints[3] - increments[0] - increments[1] - increments[2]).norm(), 0, 1e-14);
  const auto poses = accumulated(Representation::xyz_angle_axis, increments);
  Pose T;
  for (const Coordinates& c : increments) T = T * pose_from_angle_axis(AngleAxisPose(c));
  const Pose sum = pose_from_angle_axis(AngleAxisPose(poses[3]));
  EXPECT_NEAR((sum.R - T.R).norm() + (sum.p - T.p).norm(), 0, 1e-12);
}

double distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - s * (b - a)).norm();
}

TEST(StraightPath, KeepsToTheLinesAndTheLimitsAndReachesEveryPose) {
  RandomList random(5);
  for (int n = 0; n < 20; ++n) {
    std::vector<Pose> poses;
    for (int k = 0; k < 4; ++k) poses.push_back(random_pose(random));
    const StraightPath path(poses, {.velocity = 0.2, .acceleration = 0.5});
    std::vector<double> nearest(poses.size(), 1e9);
    const double h = 1e-3;
    for (double t = h; t < path.duration() - h; t += h) {
      const Vector3 p = path.at(t).head<3>();
      double off = 1e9;
      for (std::size_t k = 0; k + 1 < poses.size(); ++k)
        off = std::min(off, distance_to_segment(p, poses[k].p, poses[k + 1].p));
      EXPECT_NEAR(off, 0, 1e-9);
      EXPECT_LE((path.at(t + h).head<3>() - path.at(t).head<3>()).norm() / h, 0.2 + 1e-9);
      for (std::size_t k = 0; k < poses.size(); ++k)
        nearest[k] = std::min(nearest[k], (p - poses[k].p).norm());
    }
    for (const double d : nearest) EXPECT_LT(d, 2e-4);
    const Pose end = pose_from_angle_axis(AngleAxisPose(path.at(path.duration())));
    EXPECT_NEAR((end.p - poses.back().p).norm() + (end.R - poses.back().R).norm(), 0, 1e-9);
  }
}

TEST(StraightPath, RoundsCornersWithoutStopping) {
  const std::vector<Pose> poses{{Matrix3::Identity(), {0, 0, 0}},
                                {Matrix3::Identity(), {0.3, 0, 0}},
                                {Matrix3::Identity(), {0.3, 0.3, 0}}};
  const StraightPath round(poses, {.velocity = 0.1, .acceleration = 1, .corner = 0.05});
  const StraightPath sharp(poses, {.velocity = 0.1, .acceleration = 1});
  double slowest = 1, nearest = 1;
  for (double t = 0.5; t < round.duration() - 0.5; t += 1e-3) {
    slowest = std::min(slowest, (round.at(t + 1e-3) - round.at(t)).head<3>().norm() / 1e-3);
    nearest = std::min(nearest, (round.at(t).head<3>() - poses[1].p).norm());
  }
  EXPECT_NEAR(slowest, 0.1, 1e-3);
  EXPECT_NEAR(nearest, 0.05 * (std::sqrt(2.0) - 1), 1e-4);
  EXPECT_LT(round.duration(), sharp.duration());
}

TEST(StraightPath, TakesTheTimeOfItsLengthAndOfItsTurn) {
  const auto at = [](double x, double turn) {
    return Pose{rotation_from_angle_axis({0, 0, turn}), {x, 0, 0}};
  };
  const auto time = [&](const Pose& to, const PathLimits& limits) {
    return StraightPath({at(0, 0), to}, limits).duration();
  };
  EXPECT_NEAR(time(at(0.1, 0), {}), 0.1 / 0.05 + 0.05 / 0.2, 1e-9);
  EXPECT_NEAR(time(at(0, 1), {}), 0.2 / 0.05 + 0.05 / 0.2, 1e-9) << "a turn by one radian as a way of 0.2 m";
  EXPECT_NEAR(time(at(0, 1), {.velocity = 0.1, .acceleration = 0.5, .lever = 0.4}), 0.4 / 0.1 + 0.1 / 0.5,
              1e-9);
  EXPECT_NEAR(time(at(0.1, 0), {.corner = 0.5}), 2.25, 1e-9) << "two poses have no corner";
  const StraightPath path({at(0, 0), at(0.1, 0.5)}, {});
  EXPECT_NEAR((path.at(-1) - path.at(0)).norm(), 0, 1e-12);
  EXPECT_NEAR(path.at(path.duration() / 2)[0], 0.05, 1e-9);
  EXPECT_NEAR(path.at(path.duration() / 2)[5], 0.25, 1e-9) << "position and turn go together";
  EXPECT_EQ(path.at(path.duration()), path.at(100));
  EXPECT_NEAR(path.at(100)[5], 0.5, 1e-12);
}

TEST(StraightPath, RefusesPosesThatCannotBeJoined) {
  const auto at = [](double x) { return Pose{Matrix3::Identity(), {x, 0, 0}}; };
  EXPECT_THROW(StraightPath({at(0)}, {}), FaultError);
  EXPECT_THROW(StraightPath({}, {}), FaultError);
  EXPECT_NO_THROW(StraightPath({at(0), at(1)}, {}));
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(StraightPath({at(0), at(1)}, {.velocity = bad}), FaultError);
    EXPECT_THROW(StraightPath({at(0), at(1)}, {.acceleration = bad}), FaultError);
    EXPECT_THROW(StraightPath({at(0), at(1)}, {.lever = bad}), FaultError);
    if (bad != 0) {
      EXPECT_THROW(StraightPath({at(0), at(1)}, {.corner = bad}), FaultError);
    }
  }
  EXPECT_THROW(StraightPath({at(0), at(1), at(0.5)}, {.corner = 0.1}), FaultError) << "turns back";
  EXPECT_THROW(StraightPath({at(0), {2 * Matrix3::Identity(), {}}}, {}), FaultError);
}

}  // namespace
}  // namespace mrroc::ecp
