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
  std::string error_text(const std::string& text) {
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

TEST_F(TaughtFile, KeepsEverySpaceReferenceAndNumberOfAxes) {
  RandomList random(9);
  for (const Representation space : {Representation::motors, Representation::joints,
                                     Representation::xyz_euler_zyz, Representation::xyz_angle_axis})
    for (const Reference reference : {Reference::absolute, Reference::relative})
      for (const int axes : {1, 6, kMaxAxes})
        for (const bool with_force : {false, true}) {
          const int numbers = per_axis(space) ? axes : 6;
          TaughtPath taught{space, reference, with_force, {}};
          for (int k = 0; k < 3; ++k)
            taught.poses.push_back(
                {0.1 * k, random.pose(numbers, 100), Wrench::from(random.pose(3, 9), random.pose(3, 9))});
          save(file_, taught);
          const TaughtPath back = load_taught_path(file_);
          EXPECT_EQ(back.space, space);
          EXPECT_EQ(back.reference, reference);
          EXPECT_EQ(back.with_force, with_force);
          ASSERT_EQ(back.poses.size(), 3U);
          EXPECT_EQ(back.poses[2].pose, taught.poses[2].pose);
          EXPECT_EQ(back.poses[2].t, taught.poses[2].t);
          EXPECT_EQ(back.poses[2].F, with_force ? taught.poses[2].F : Wrench{});
        }
}

TEST_F(TaughtFile, IsWrittenAsItSays) {
  TaughtPath taught{Representation::joints, Reference::relative, true, {}};
  taught.poses.push_back({0, Eigen::Vector2d(1, -0.5), {{1, 2, 3, 4, 5, 6}}});
  taught.poses.push_back({0.25, Eigen::Vector2d(2, 0), {}});
  EXPECT_EQ(saved(taught),
            "mrroc-trajectory 1\nspace joints\nreference relative\nnumbers 2\nforce yes\nposes 2\n"
            "0 1 -0.5 1 2 3 4 5 6\n0.25 2 0 0 0 0 0 0 0\nend\n");
}

TEST_F(TaughtFile, IsNotWrittenWithANumberThatIsNotFinite) {
  for (int k = 0; k < 3; ++k) {
    TaughtPath taught = random_path(5, true);
    (k == 0 ? taught.poses[3].t : k == 1 ? taught.poses[3].pose[2] : taught.poses[3].F[Axis::az]) = NAN;
    EXPECT_THROW(save(file_, taught), FileError);
    EXPECT_FALSE(fs::exists(file_));
  }
}

TEST_F(TaughtFile, AWordThatIsNoneIsToldWithThoseThatAre) {
  const std::string head = "mrroc-trajectory 1\n";
  EXPECT_NE(error_text("mrroc 1\n").find("it must begin with 'mrroc-trajectory 1'"), std::string::npos);
  EXPECT_NE(error_text(head + "space frame\n")
                .find("'frame' is no space; it must be motors or joints or "
                      "xyz_euler_zyz or xyz_angle_axis"),
            std::string::npos);
  for (const char* line : {"spaces joints\n", "space\n", "space joint\n", "joints\n"})
    EXPECT_TRUE(error_text(head + line).starts_with("2: ")) << line;
  const std::string up_to_numbers = head + "space joints\nreference absolute\n";
  for (const char* numbers : {"0", "9", "-1", "x"})
    EXPECT_TRUE(error_text(up_to_numbers + "numbers " + numbers + "\n").starts_with("4: ")) << numbers;
  EXPECT_TRUE(error_text(head + "space xyz_euler_zyz\nreference absolute\nnumbers 7\n").starts_with("4: "));
  const std::string up_to_poses = up_to_numbers + "numbers 1\nforce no\nposes 2\n";
  EXPECT_EQ(error_text(up_to_poses + "0 1\n0.1 2\nend\n"), "");
  EXPECT_NE(error_text(up_to_poses + "0 1\n0 2\nend\n").find("time does not rise"), std::string::npos);
  EXPECT_NE(error_text(up_to_poses + "0 1 5\n0.1 2\nend\n").find("more than 2 numbers"), std::string::npos);
}

TEST_F(TaughtFile, OfTooManyPosesOrBytesIsRefusedBeforeItIsRead) {
  const std::string head = "mrroc-trajectory 1\nspace joints\nreference absolute\nnumbers 1\nforce no\n";
  EXPECT_TRUE(error_text(head + "poses 10000001\n").starts_with("6: "));
  EXPECT_TRUE(error_text(head + "poses 10000000\n").starts_with("7: ")) << "so many may come";
  EXPECT_NE(error_text(head + "poses 10000001\n").find("from 0 to 10000000"), std::string::npos);
  std::ofstream(file_) << head;
  fs::resize_file(file_, 500'000'001);  // it has holes and takes no room
  try {
    static_cast<void>(load_taught_path(file_));
    ADD_FAILURE();
  } catch (const FileError& e) {
    EXPECT_NE(std::string(e.what()).find("over the limit of 500000000"), std::string::npos) << e.what();
  }
}

TEST_F(TaughtFile, IsRefusedWithLineAndReason) {
  const std::string good = saved(random_path(2, false));
  EXPECT_EQ(error_text(good), "");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return error_text(text);
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
  EXPECT_NE(error_text(good.substr(0, good.size() - 5)).find("truncated"), std::string::npos);
  EXPECT_NE(error_text(good.substr(0, 60) + "nan" + good.substr(60)), "");
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

TEST(TeachIn, RelativePosesAreSeenFromTheFirstOne) {
  RandomList random(8);
  std::vector<Coordinates> poses;
  for (int k = 0; k < 5; ++k) poses.push_back(random.pose(6, 1));
  const auto taught = [&](Representation space) {
    TeachIn t(space, Reference::relative, false, 6);
    EffectorReply reply;
    for (const Coordinates& q : poses) {
      reply.pose = numbers_from_axes(q);
      t = t.appended(reply, static_cast<double>(t.size()));
    }
    return t.path().poses;
  };
  const std::vector<TaughtPose> joints = taught(Representation::joints);
  for (std::size_t k = 0; k < poses.size(); ++k) EXPECT_EQ(joints[k].pose, poses[k] - poses[0]);
  const std::vector<TaughtPose> seen = taught(Representation::xyz_angle_axis);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose T =
        pose_from_angle_axis(AngleAxisPose(poses[0])) * pose_from_angle_axis(AngleAxisPose(seen[k].pose));
    const Pose there = pose_from_angle_axis(AngleAxisPose(poses[k]));
    EXPECT_NEAR((T.p - there.p).norm() + (T.R - there.R).norm(), 0, 1e-12) << k;
  }
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

TEST(Replay, ForcesAreThoseAtTheEndOfTheMacrostepAndOfTheAxesInContactAlone) {
  const TaughtPath taught = random_path(6, true);
  const Replay replay(taught, Interpolation::tcim_pose, {.dt = 0.002, .n_s = 20, .n_Q = 5});
  EXPECT_EQ(replay.path().macrosteps(), 20) << "of twice the length";
  TaskFrameCommand rows;
  for (const Axis a : {Axis::y, Axis::ax}) rows[a] = c(3, 20, 0.005);
  rows.z = g(0.1, 5, 0.01);
  for (int k = 0; k < 18; ++k) {
    const Wrench& there = taught.poses[static_cast<std::size_t>(2 * (k + 1))].F;
    EXPECT_LT((replay.force(k).vector() - there.vector()).norm(), 1e-9);
    const ArmCommand command = replay.command(k, rows);
    EXPECT_EQ(command.n_s, 20);
    EXPECT_EQ(command.n_Q, 5);
    for (const Axis a : kAxes)
      EXPECT_NEAR(command.frame[a].force, rows[a].b == Behaviour::contact ? there[a] : rows[a].force, 1e-9);
  }
  EXPECT_EQ(replay.force(1000), taught.poses.back().F) << "the last one";
}

TEST(Replay, OfAnglesTakesTheShortWayRound) {
  TaughtPath taught{Representation::xyz_angle_axis, Reference::absolute, false, {}};
  for (const double angle : {3.0, 3.1, -3.1, -3.0}) {  // through pi
    Coordinates q = Coordinates::Zero(6);
    q[5] = angle;
    taught.poses.push_back({0.1 * static_cast<double>(taught.poses.size()), q});
  }
  const Replay replay(taught, Interpolation::mim);
  for (std::int64_t k = 0; k < replay.path().macrosteps(); ++k)
    EXPECT_LT((replay.path().set_position(k + 1) - replay.path().set_position(k)).norm(), 0.05);
}

TEST(TeachIn, HasSixNumbersForAPoseWhateverTheRobotAndTellsWhatItIsOf) {
  const TeachIn taught = TeachIn(Representation::xyz_euler_zyz, Reference::relative, true, 2).appended({}, 1);
  EXPECT_EQ(taught.path().poses[0].pose.size(), 6);
  EXPECT_EQ(taught.path().space, Representation::xyz_euler_zyz);
  EXPECT_EQ(taught.path().reference, Reference::relative);
  EXPECT_TRUE(taught.path().with_force);
  EXPECT_EQ(TeachIn(Representation::motors, Reference::absolute, false, 2)
                .appended({}, 1)
                .path()
                .poses[0]
                .pose.size(),
            2);
  EXPECT_EQ(TeachIn().path().poses.size(), 0U);
  EXPECT_EQ(TeachIn().path().space, Representation::xyz_angle_axis);
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
  EXPECT_EQ(both.instruction, Instruction::set_get) << "as it was";
  EXPECT_TRUE(both.robot_model.set_tool);
  EXPECT_EQ(both.robot_model.tool_representation, Representation::frame);
  EXPECT_EQ(both.robot_model.tool[11], 0.25);
  EXPECT_EQ(with_tool(rest(), {}).instruction, Instruction::set);
  EXPECT_TRUE(has(bias_force().set, Part::force_bias));
  const EffectorCommand weight = change_force_tool(10, {1, 2, 3});
  EXPECT_TRUE(weight.robot_model.set_force_tool);
  EXPECT_EQ(weight.instruction, Instruction::set);
  EXPECT_TRUE(has(weight.set, Part::robot_model));
  EXPECT_FALSE(weight.robot_model.set_tool);
  EXPECT_EQ(weight.robot_model.weight, 10);
  EXPECT_EQ(weight.robot_model.mass_centre, (std::array<double, 3>{1, 2, 3}));
  X x;
  x.T.arm = moved.arm;
  EXPECT_EQ(copied_order(x).arm.frame, moved.arm.frame);
  x.T.late = true;
  EXPECT_EQ(copied_order(x).instruction, Instruction::keep);
}

}  // namespace
}  // namespace mrroc::ecp
