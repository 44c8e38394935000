#include "ecp/generators/teach_in.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/representation.hpp"
#include "base/text_file.hpp"
#include "ecp/generators/rows.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

namespace fs = std::filesystem;

TaughtPath random_path(unsigned seed, bool with_force) {
  RandomList random(seed);
  TeachIn taught(Representation::xyz_angle_axis, Reference::absolute, with_force, 6);
  EffectorReply reply;
  for (int k = 0; k < 40; ++k) {
    reply.pose = numbers_from_axes(random.pose(6, 1) * 0.01 + Coordinates::Constant(6, 0.02 * k));
    if (with_force) reply.F_a = Wrench::from(random.pose(3, 5), random.pose(3, 1));
    taught = taught.appended(reply, 3 + 0.02 * k);
  }
  return taught.path();
}

class TaughtFile : public testing::Test {
 protected:
  TaughtFile() : file_(fs::path(testing::TempDir()) / ("taught_" + std::to_string(::getpid()) + ".txt")) {}
  ~TaughtFile() override { fs::remove(file_); }
  std::string saved(const TaughtPath& taught) {
    save(file_, taught);
    std::ifstream in(file_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string complaint(const std::string& text) {
    std::ofstream(file_) << text;
    try {
      static_cast<void>(load_taught_path(file_));
    } catch (const FileError& e) {
      return std::to_string(e.line()) + ": " + e.what();
    }
    return "";
  }

  fs::path file_;
};

TEST_F(TaughtFile, ComesBackBitByBit) {
  for (const bool with_force : {false, true}) {
    const TaughtPath taught = random_path(1, with_force);
    save(file_, taught);
    const TaughtPath back = load_taught_path(file_);
    EXPECT_EQ(back.space, taught.space);
    EXPECT_EQ(back.reference, taught.reference);
    EXPECT_EQ(back.with_force, with_force);
    ASSERT_EQ(back.poses.size(), taught.poses.size());
    for (std::size_t k = 0; k < back.poses.size(); ++k) {
      EXPECT_EQ(back.poses[k].t, taught.poses[k].t);
      EXPECT_EQ(back.poses[k].pose, taught.poses[k].pose);
      EXPECT_EQ(back.poses[k].F, taught.poses[k].F);
    }
  }
}

TEST_F(TaughtFile, IsRefusedWithLineAndReason) {
  const std::string good = saved(random_path(2, false));
  EXPECT_EQ(complaint(good), "");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return complaint(text);
  };
  EXPECT_TRUE(changed("trajectory 1", "trajectory 2").starts_with("1: "));
  EXPECT_NE(changed("xyz_angle_axis", "frame").find("no space"), std::string::npos);
  EXPECT_TRUE(changed("absolute", "sideways").starts_with("3: "));
  EXPECT_TRUE(changed("numbers 6", "numbers 5").starts_with("4: "));
  EXPECT_TRUE(changed("force no", "force yes").starts_with("7: "));
  EXPECT_TRUE(changed("poses 40", "poses 41").find("finite number") != std::string::npos);
  EXPECT_NE(changed("poses 40", "poses 39").find("'end'"), std::string::npos);
  EXPECT_NE(changed("poses 40", "poses 1").find("two poses"), std::string::npos);
  EXPECT_NE(changed("end\n", "end\nmore\n").find("behind the end"), std::string::npos);
  EXPECT_NE(complaint(good.substr(0, good.size() - 5)).find("truncated"), std::string::npos);
  EXPECT_NE(complaint(good.substr(0, 60) + "nan" + good.substr(60)), "");
}

TEST_F(TaughtFile, ThatDoesNotExistIsRefused) {
  EXPECT_THROW(static_cast<void>(load_taught_path("/nowhere/taught.txt")), FileError);
}

TEST(TeachIn, VersionsAreValues) {
  EffectorReply reply;
  const auto at = [&](double q) {
    reply.pose[0] = q;
    return reply;
  };
  const TeachIn empty(Representation::joints, Reference::absolute, false, 2);
  const TeachIn one = empty.appended(at(1), 5);
  const TeachIn two = one.appended(at(2), 6), other = one.appended(at(3), 7);
  EXPECT_EQ(empty.size(), 0u);
  EXPECT_EQ(one.path().poses.size(), 1u);
  EXPECT_EQ(two.path().poses[1].pose[0], 2);
  EXPECT_EQ(other.path().poses[1].pose[0], 3);
  EXPECT_EQ(other.path().poses[1].t, 2) << "time begins with the first pose";
  EXPECT_EQ(two.path().poses[1].pose.size(), 2) << "one number per axis";
}

TEST(TeachIn, RelativeToTheFirstPoseIsTheSameMotionFromAnywhere) {
  RandomList random(7);
  TeachIn absolute(Representation::xyz_angle_axis, Reference::absolute, false, 6);
  TeachIn relative(Representation::xyz_angle_axis, Reference::relative, false, 6);
  EffectorReply reply;
  for (int k = 0; k < 10; ++k) {
    reply.pose = numbers_from_axes(random.pose(6, 1));
    absolute = absolute.appended(reply, 0.02 * k);
    relative = relative.appended(reply, 0.02 * k);
  }
  const auto pose = [](const TaughtPath& path, std::size_t k) {
    return pose_from_angle_axis(AngleAxisPose(path.poses[k].pose));
  };
  const Replay replay(relative.path(), Interpolation::tcim_pose);
  Pose T = pose(absolute.path(), 0);
  for (int k = 0; k < 9; ++k) {
    const ArmCommand command = replay.path().command(k);
    EXPECT_EQ(command.reference, Reference::relative);
    T = T * *pose_from_numbers(command.representation, command.pose);
  }
  EXPECT_NEAR((T.p - pose(absolute.path(), 9).p).norm(), 0, 1e-9);
  EXPECT_NEAR((T.R - pose(absolute.path(), 9).R).norm(), 0, 1e-9);
}

TEST(Replay, GoesThroughTheRecordedPosesWithTheRecordedForces) {
  const TaughtPath taught = random_path(3, true);
  const Replay replay(taught, Interpolation::tcim_pose);
  ASSERT_EQ(replay.path().macrosteps(), 39);
  TaskFrameCommand rows;
  rows.z = c(0, 20, 0.005);
  for (int k = 0; k < 39; ++k) {
    const TaughtPose& there = taught.poses[static_cast<std::size_t>(k + 1)];
    const ArmCommand command = replay.command(k, rows);
    EXPECT_EQ(command.mu, Interpolation::tcim_pose);
    EXPECT_NEAR((axes_from_numbers(command.pose, 6) - there.pose).norm(), 0, 1e-9);
    EXPECT_NEAR(command.frame.z.force, there.F[Axis::z], 1e-9);
    EXPECT_EQ(command.frame.z.b, Behaviour::contact);
    EXPECT_EQ(command.frame.x, rows.x) << "not force controlled: as given";
  }
}

TEST(Replay, NeedsTheTaskFrameForForces) {
  EXPECT_THROW(Replay(random_path(4, true), Interpolation::mim), FaultError);
  EXPECT_NO_THROW(Replay(random_path(4, false), Interpolation::mim));
  EXPECT_EQ(Replay(random_path(4, false), Interpolation::mim).force(3), Wrench{});
}

struct Memory {
  Trajectory path;
};
using X = ArmAgent<Memory>::X;

TEST(Rows, FollowThePathOfTheMemoryFromTheBeginningOfTheBehaviour) {
  X x;
  x.c.path = Trajectory(linear_spline({{0, Coordinates::Zero(6)}, {0.1, Coordinates::Constant(6, 1)}}), {});
  x.i_0 = 100;
  for (x.i = 100; !path_ends(x); ++x.i)
    EXPECT_NEAR(follow_path(x).arm.pose[0], 0.2 * static_cast<double>(x.i - 99), 1e-12);
  EXPECT_EQ(x.i, 105);
}

TEST(Rows, CommandsSetWhatTheySay) {
  const EffectorCommand moved = move_arm(TaskFrameCommand{.x = u(0.1)});
  EXPECT_EQ(moved.instruction, Instruction::set_get);
  EXPECT_TRUE(has(moved.set, Part::arm));
  EXPECT_EQ(moved.arm.frame.x, u(0.1));
  const EffectorCommand both = with_tool(moved, Pose{Matrix3::Identity(), {0, 0, 0.25}});
  EXPECT_TRUE(has(both.set, Part::arm) && has(both.set, Part::robot_model));
  EXPECT_EQ(both.robot_model.tool[11], 0.25);
  EXPECT_EQ(with_tool(rest(), {}).instruction, Instruction::set);
  EXPECT_TRUE(has(bias_force().set, Part::force_bias));
  const EffectorCommand weight = change_force_tool(10, {1, 2, 3});
  EXPECT_TRUE(weight.robot_model.set_force_tool);
  EXPECT_EQ(weight.robot_model.mass_centre[2], 3);
  X x;
  x.T.arm = moved.arm;
  EXPECT_EQ(copied_order(x).arm.frame, moved.arm.frame);
}

}  // namespace
}  // namespace mrroc::ecp
