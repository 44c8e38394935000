// Commands at a pace of task time: whatever a pause does, the same path, the same forces.
#include "ecp/generators/paced_command.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "base/representation.hpp"
#include "base/screw.hpp"
#include "base/task_clock.hpp"
#include "ecp/generators/commands.hpp"

namespace mrroc::ecp {
namespace {

/// Paces of a clock whose pauses come and go at random, with every macrostep of the ramps.
class RandomPauses {
 public:
  explicit RandomPauses(unsigned seed) : random_(seed) {}
  double operator()() {
    if (left_-- <= 0) {
      paused_ = !paused_;
      left_ = static_cast<int>(random_() % 35);
    }
    clock_.advance(paused_);
    return clock_.now().pace;
  }

 private:
  std::mt19937 random_;
  TaskClock clock_ = TaskClock::ramped();
  bool paused_{true};
  int left_{};
};

EffectorCommand to_joints(double q, Reference reference = Reference::absolute) {
  ArmCommand arm;
  arm.mu = Interpolation::mim;
  arm.representation = Representation::joints;
  arm.reference = reference;
  arm.pose[0] = q;
  arm.pose[5] = -2 * q;
  return move_arm(arm);
}

/// Executes commands at these paces. @return what was sent
template <class Make, class Pace>
std::vector<EffectorCommand> sent(int commands, Make make, Pace pace, EffectorReply reply = {}) {
  std::vector<EffectorCommand> all;
  PacedCommand paced;
  for (int k = 0; k < commands;) {
    const double s = pace();
    if (paced.ends_within(s)) paced.begin(make(k++));
    all.push_back(paced.part(s, reply));
    if (s > 0) reply.joints[0] = all.back().arm.pose[0];
  }
  return all;
}

TEST(PacedCommand, AtFullPaceEveryCommandIsSentAsItIs) {
  const auto all = sent(
      20, [](int k) { return to_joints(0.01 * k * k); }, [] { return 1.0; });
  ASSERT_EQ(all.size(), 20U);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(all[static_cast<std::size_t>(k)].arm.pose[0], 0.01 * k * k);
}

TEST(PacedCommand, AtFullPaceNothingOfACommandIsChangedWhateverTheDriversState) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const DriverState state : {DriverState::ready, DriverState::executing, DriverState::faulted})
    for (const Reference reference : {Reference::absolute, Reference::relative})
      for (const Representation space :
           {Representation::motors, Representation::joints, Representation::frame,
            Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
        ArmCommand arm;
        arm.mu = Interpolation::mim;
        arm.reference = reference;
        arm.representation = space;
        if (space == Representation::frame) {
          const Vector3 turn(number(random), number(random), number(random));
          const Vector3 shift(number(random), number(random), number(random));
          arm.pose = numbers_from_pose(space, Pose{rotation_from_angle_axis(turn), shift});
        } else {
          for (std::size_t k = 0; k < 6; ++k) arm.pose[k] = number(random);
        }
        EffectorReply reply;
        reply.state = state;
        reply.joints[0] = reply.motors[0] = 1. / 3;
        PacedCommand command;
        command.begin(move_arm(arm));
        const EffectorCommand given = command.part(1, reply);
        EXPECT_TRUE(command.was_whole());
        EXPECT_EQ(given.instruction, move_arm(arm).instruction) << "the driver says what it refuses";
        EXPECT_EQ(given.set, move_arm(arm).set);
        EXPECT_EQ(given.arm.pose, arm.pose) << "to the last digit";
      }
}

TEST(PacedCommand, AWayOfPosesIsTheSameAtAnyPace) {
  // Sections of different length: wherever the arm is told to be, that is on the way, and it never goes back.
  const auto goal = [](int k) { return 0.01 * (k + 1) * (k + 1); };
  for (unsigned seed = 1; seed <= 100; ++seed) {
    RandomPauses pace(seed);
    double task_time = 0, before = 0;
    const auto paced = [&] {
      const double s = pace();
      task_time += s;
      return s;
    };
    PacedCommand command;
    EffectorReply reply;
    for (int k = 0; k < 60;) {
      const double s = paced();
      if (command.ends_within(s)) command.begin(to_joints(goal(k++)));
      const EffectorCommand c = command.part(s, reply);
      const int whole = static_cast<int>(std::floor(task_time + 1e-9));
      const double from = whole == 0 ? 0 : goal(whole - 1);
      const double expected = from + (task_time - whole) * (goal(whole) - from);
      if (has(c.set, Part::arm)) {
        EXPECT_NEAR(c.arm.pose[0], expected, 1e-9) << "seed " << seed << ", task time " << task_time;
        EXPECT_NEAR(c.arm.pose[5], -2 * expected, 1e-9);
        EXPECT_GE(c.arm.pose[0], before - 1e-12);
        before = c.arm.pose[0];
      }
    }
  }
}

TEST(PacedCommand, DisplacementsAddUpToTheSameAtAnyPace) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    RandomPauses pace(seed);
    double sum = 0;
    const auto all = sent(
        50, [](int k) { return to_joints(0.001 * k, Reference::relative); }, pace);
    for (const EffectorCommand& c : all) sum += c.arm.pose[0];
    // The last one may not have come to its end.
    EXPECT_GE(sum, 0.001 * 48 * 49 / 2 - 1e-9);
    EXPECT_LE(sum, 0.001 * 49 * 50 / 2 + 1e-9);
  }
}

TEST(PacedCommand, ADisplacementInSpaceIsMadeInPiecesOfTheSameMotion) {
  const Pose T{rotation_from_angle_axis({0.01, -0.02, 0.03}), Vector3(0.004, 0.001, -0.002)};
  ArmCommand arm;
  arm.mu = Interpolation::mim;
  arm.representation = Representation::frame;
  arm.reference = Reference::relative;
  arm.pose = numbers_from_pose(Representation::frame, T);
  PacedCommand command;
  command.begin(move_arm(arm));
  Pose sum;
  for (const double s : {0.3, 0.0, 0.25, 0.45}) {
    const auto piece = pose_from_numbers(Representation::frame, command.part(s, {}).arm.pose);
    ASSERT_TRUE(piece);
    sum = sum * *piece;
    EXPECT_NEAR(log_screw(*piece).vector().norm(), s * log_screw(T).vector().norm(), 1e-9);
  }
  EXPECT_LT((sum.p - T.p).norm(), 1e-9);
  EXPECT_LT((sum.R - T.R).norm(), 1e-9);
  EXPECT_FALSE(command.ends_within(0)) << "and a pause goes on for ever";
  EXPECT_TRUE(command.ends_within(0.1));
}

// In the macrostep in which one displacement ends and the next one begins both are in one command, one after the other.
TEST(PacedCommand, DisplacementsInSpaceFollowOneAnotherAtAnyPace) {
  const Pose first{rotation_from_angle_axis({0.5, -0.2, 0.3}), Vector3(0.04, 0.01, -0.02)};
  const Pose second{rotation_from_angle_axis({-0.1, 0.6, 0.2}), Vector3(-0.01, 0.05, 0.03)};
  for (const Representation space :
       {Representation::frame, Representation::xyz_euler_zyz, Representation::xyz_angle_axis})
    for (const std::vector<double>& paces :
         {std::vector<double>{0.6, 0.6, 0.6, 0.2}, std::vector<double>{0.9, 0.3, 0.5, 0.3},
          std::vector<double>{0.5, 0.5, 0.25, 0.75}}) {
      PacedCommand command;
      std::vector<Pose> next{second, first};
      Pose sum;
      for (const double pace : paces) {
        if (command.ends_within(pace)) {
          ArmCommand arm;
          arm.mu = Interpolation::mim;
          arm.representation = space;
          arm.reference = Reference::relative;
          arm.pose = numbers_from_pose(space, next.back());
          next.pop_back();
          command.begin(move_arm(arm));
        }
        const auto piece = pose_from_numbers(space, command.part(pace, {}).arm.pose);
        ASSERT_TRUE(piece);
        sum = sum * *piece;
      }
      ASSERT_TRUE(next.empty());
      const Pose expected = first * second;
      EXPECT_LT((sum.p - expected.p).norm(), 1e-9) << static_cast<int>(space) << ", " << paces[0];
      EXPECT_LT((sum.R - expected.R).norm(), 1e-9) << static_cast<int>(space) << ", " << paces[0];
    }
}

TEST(PacedCommand, AWayThatBeginsInARampBeginsWhereTheArmIs) {
  PacedCommand command;
  EffectorReply reply;
  reply.joints[0] = 0.5;
  command.begin(to_joints(0.6));
  EXPECT_NEAR(command.part(0.4, reply).arm.pose[0], 0.54, 1e-12);
  reply.joints[0] = 0.51;  // behind, as drives are
  EXPECT_NEAR(command.part(0.3, reply).arm.pose[0], 0.57, 1e-12);
}

TEST(PacedCommand, AWayThatBeginsInARampBeginsAtWhatWasMeasuredInItsOwnRepresentation) {
  EffectorReply reply;
  reply.T_0E = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  for (std::size_t k = 0; k < 6; ++k) {
    reply.motors[k] = 10 + static_cast<double>(k);
    reply.joints[k] = 20 + static_cast<double>(k);
  }
  const auto first_of = [&reply](Representation space) {
    ArmCommand arm;
    arm.mu = Interpolation::mim;
    arm.representation = space;
    arm.pose = numbers_from_pose(Representation::xyz_angle_axis, Pose{});
    PacedCommand command;
    command.begin(move_arm(arm));
    return command.part(0, reply).arm.pose;
  };
  const PoseNumbers motors = first_of(Representation::motors), joints = first_of(Representation::joints),
                    pose = first_of(Representation::xyz_angle_axis);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(motors[k], 10 + static_cast<double>(k));
    EXPECT_EQ(joints[k], 20 + static_cast<double>(k));
    EXPECT_NEAR(pose[k], reply.T_0E[k], 1e-12);
  }
}

TEST(PacedCommand, WhatIsNoMotionIsSentOnceAndThenTheArmRests) {
  PacedCommand command;
  command.begin(bias_force());
  EXPECT_TRUE(has(command.part(0, {}).set, Part::force_bias));
  for (int k = 0; k < 20; ++k) EXPECT_EQ(command.part(0, {}).instruction, Instruction::keep);
}

TEST(PacedCommand, ADriverInTheStateOfAFaultGetsNoMotion) {
  PacedCommand command;
  command.begin(to_joints(1));
  EffectorReply reply;
  (void)command.part(0.5, reply);
  reply.state = DriverState::faulted;
  EXPECT_EQ(command.part(0, reply).instruction, Instruction::keep);
}

TEST(AtPace, ScalesEveryVelocityAndNothingElse) {
  const TaskFrameCommand frame{
      .x = u(1), .y = g(2, 3, 4), .z = c(5, 6, 7), .ax = u(8), .ay = g(9, 1, 1), .az = u(-1)};
  for (const double pace : {0.0, 0.5, 1.0}) {
    const TaskFrameCommand slow = at_pace(frame, pace);
    for (const Axis a : kAxes) {
      EXPECT_EQ(slow[a].velocity, pace * frame[a].velocity);
      AxisCommand rest = slow[a];
      rest.velocity = frame[a].velocity;
      EXPECT_EQ(rest, frame[a]);
    }
  }
}

TEST(AtPace, OnlyGuardedAxesThatMoveHoldAForce) {
  const TaskFrameCommand frame{
      .x = g(0, 5, 0.0025), .y = u(0.01), .z = g(0.01, 5, 0.0025), .ay = c(0.01, 5, 0.0025)};
  HeldShares before;
  for (const Axis a : kAxes) before[a] = 0.7;
  for (const double force : {0.0, 3.0, -3.0}) {
    Wrench F_a;
    for (const Axis a : kAxes) F_a[a] = force;
    for (const double pace : {0.0, 0.5}) {
      const HeldShares held = held_shares(frame, F_a, before, pace);
      for (const Axis a : kAxes)
        EXPECT_EQ(held[a], a != Axis::z || force <= 0 ? 0 : pace == 0 ? 0.7 : 0.75) << force << ' ' << pace;
    }
  }
}

// From 0.15 of the force at which it settles an axis has contact, from 0.8 on it is settled.
TEST(AtPace, TheShareHeldIsThatOfTheForceBetweenContactAndRest) {
  const TaskFrameCommand frame{.z = g(0.5, 5, 0.5)};
  const auto held = [&](double force) {
    Wrench F_a;
    F_a[Axis::z] = force;
    return held_shares(frame, F_a, {}, 0.5)[Axis::z];
  };
  EXPECT_EQ(held(0.149), 0);
  EXPECT_EQ(held(0.15), 0.15);
  EXPECT_EQ(held(0.799), 0.799);
  EXPECT_EQ(held(0.8), 1);
  EXPECT_EQ(held(2), 1);
}

/// @return velocity of a guarded axis that settles at 4 N, in a pause that found it with that force [of the whole one]
double kept_at(double force, double in_the_pause) {
  PacedCommand command;
  command.begin(move_arm({.z = g(0.01, 5, 0.0025)}));
  EffectorReply reply;
  reply.F_a[Axis::z] = force;
  for (int k = 9; k > 0; --k) (void)command.part(0.01 * k, reply);
  EffectorCommand c;
  reply.F_a[Axis::z] = in_the_pause;
  for (int k = 0; k < 3; ++k) c = command.part(0, reply);
  return c.arm.frame.z.velocity / 0.01;
}

TEST(AtPace, AGuardedAxisKeepsItsForceAndStandsWithoutContact) {
  EXPECT_EQ(kept_at(4, 4), 1) << "its velocity is what it presses with";
  EXPECT_EQ(kept_at(3.7, 4.2), 1) << "it settles as without a pause";
  EXPECT_EQ(kept_at(0, 0), 0) << "it stands in the air";
  EXPECT_EQ(kept_at(0.3, 0.3), 0) << "and does not mind noise";
  EXPECT_EQ(kept_at(-4, -4), 0) << "nor a force that pushes it on";
  EXPECT_NEAR(kept_at(2, 2), 0.5, 1e-12) << "on its way to contact it holds the force that it has";
  EXPECT_EQ(kept_at(4, 0), 0) << "when what it pressed on is taken away, it stands";
  EXPECT_EQ(kept_at(0, 4), 0) << "and a force that comes in the pause does not set it in motion";
}

}  // namespace
}  // namespace mrroc::ecp
