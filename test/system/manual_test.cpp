// Manual operation in lock-step: everything that the operator can tell the arms, from a script, and from a terminal.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/link/log_reader.hpp"
#include "base/msg/convert.hpp"
#include "base/representation.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKnown{"--set", "robots.arm1.synchro=\"known_pose\"", "--set",
                                      "robots.arm2.synchro=\"known_pose\""};

class Manual : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
  }

  /// Runs a script of instructions. @return the replies of an arm by macrostep
  std::map<std::int64_t, EffectorReply> replies(const std::string& script, const std::string& arm = "arm1",
                                                const std::vector<std::string>& more = kKnown) {
    run_ = folder_ / "run";
    const Ended ended = run(
        folder_, "manual",
        words({{"--processes", "one", "--run-dir", run_.string(), "--words", folder_.write("words", script)},
               more}));
    EXPECT_EQ(ended.status, 0) << ended.all();
    std::map<std::int64_t, EffectorReply> all;
    for (const auto& [i, m] : link::LogReader(run_).messages<effector_reply_t>(arm + ".reply"))
      all[i] = from_message(m);
    return all;
  }
  static const EffectorReply& last(const std::map<std::int64_t, EffectorReply>& all) {
    return std::prev(all.end(), 4)->second;  // before the release
  }
  static Pose pose(const EffectorReply& r) {
    PoseNumbers n{};
    std::ranges::copy(r.T_0E, n.begin());
    return pose_from_numbers(Representation::xyz_angle_axis, n).value();
  }

  Folder folder_;
  fs::path run_;
};

TEST_F(Manual, MovesInMotorsJointsAndPosesAndEveryProcessIsRecomputed) {
  const auto all = replies(
      "3 home all\n"
      "100 move arm1 joints 0.1 -1.5 0 1.5 1.57 -1.57 speed 0.5 acceleration 0.2\n"
      "360 jog arm1 joints 0.05 0 0 0 0 0 speed 0.5 acceleration 0.2\n"
      "460 jog arm1 motors 5 0 0 0 0 0 speed 0.5 acceleration 0.2\n"
      "560 jog arm1 angle-axis 0 0 0.02 0 0 0 speed 0.5 acceleration 0.2\n"
      "660 jog arm1 euler 0 0.01 0 0 0 0 speed 0.5 acceleration 0.2\n"
      "760 preset arm1 front speed 0.5 acceleration 0.2\n"
      "770 end\n");
  EXPECT_NEAR(all.at(355).joints[0], 0.1, 2e-3);
  EXPECT_NEAR(all.at(355).joints[1], -1.5, 2e-3);
  EXPECT_NEAR(all.at(455).joints[0], 0.15, 2e-3);
  EXPECT_NEAR(all.at(555).motors[0] - all.at(455).motors[0], 5, 0.05);
  const Pose tool = pose(all.at(555)).inverse() * pose(all.at(655));
  EXPECT_NEAR(tool.p.z(), 0.02, 1e-3) << "along the tool";
  EXPECT_NEAR(tool.p.head<2>().norm(), 0, 1e-3);
  EXPECT_NEAR((pose(all.at(655)).inverse() * pose(all.at(755))).p.y(), 0.01, 1e-3);
  EXPECT_NEAR(last(all).joints[1], -1.57, 2e-3);
  EXPECT_EQ(last(all).state, DriverState::holding);
  const Ended checked = run(folder_, "ui_cli", {"log", "check", run_.string()});
  EXPECT_EQ(checked.status, 0) << checked.all();  // nothing differs, and all came to their ends
}

TEST_F(Manual, GoesToEveryPresetWithAllArms) {
  const auto all = replies(
      "3 home all\n"
      "100 preset all synchro speed 0.5 acceleration 0.5\n"
      "600 preset all front speed 0.5 acceleration 0.5\n"
      "900 preset all 1 speed 0.3 acceleration 0.5\n"
      "1200 preset all 2 speed 0.3 acceleration 0.5\n"
      "1600 preset all 0 speed 0.3 acceleration 0.5\n"
      "1700 end\n");
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(all.at(595).motors[k], 0, 1) << k;  // [rad], 0.01 of a joint
  EXPECT_NEAR(all.at(895).joints[4], 1.57, 2e-3);
  EXPECT_NEAR(all.at(1195).joints[0], 0.5, 2e-3);
  EXPECT_NEAR(all.at(1595).joints[0], -0.5, 2e-3);
  EXPECT_NEAR(last(all).joints[0], 0, 2e-3);
  std::ifstream log(run_ / "messages.log");
  const std::string text(std::istreambuf_iterator<char>(log), {});
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
}

TEST_F(Manual, SetsToolModelServoAndForceAndTheDriverTellsThem) {
  const auto all = replies(
      "3 home arm1\n"
      "100 tool arm1 0 0 0.3 0 0 0\n"
      "110 weight arm1 3 0 0 0.05\n"
      "130 servo arm1 0 1\n"
      "140 model arm1 1\n"
      "160 bias arm1\n"
      "180 end\n");
  const RobotModel &before = all.at(99).robot_model, &after = last(all).robot_model;
  EXPECT_GT(std::abs((pose(all.at(99)).inverse() * pose(all.at(109))).p.z()), 0.01) << "E is elsewhere";
  const auto tool = pose_from_numbers(after.tool_representation, after.tool);
  ASSERT_TRUE(tool);
  EXPECT_NEAR(tool->p.z(), 0.3, 1e-9);
  EXPECT_EQ(after.weight, 3);
  EXPECT_EQ(after.mass_centre, (std::array<double, 3>{0, 0, 0.05}));
  EXPECT_EQ(before.kinematic_model, 0);
  EXPECT_EQ(after.kinematic_model, 1);
  EXPECT_GT((pose(all.at(139)).inverse() * pose(all.at(159))).p.norm(), 1e-6)
      << "the same joints, another pose";
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NE(std::pair(before.servo_algorithm[k], before.servo_parameter_set[k]),
              (std::pair<std::uint8_t, std::uint8_t>(0, 1)))
        << k;
    EXPECT_EQ(after.servo_algorithm[k], 0) << k;
    EXPECT_EQ(after.servo_parameter_set[k], 1) << k;
  }
  EXPECT_NEAR(last(all).F_a[Axis::z], 0, 0.5);
  std::ifstream log(run_ / "messages.log");
  const std::string text(std::istreambuf_iterator<char>(log), {});
  EXPECT_EQ(text.find("refused"), std::string::npos) << text;
}

TEST_F(Manual, AnArmThatIsNotHomedIsJoggedByItsMotorsAndRefusesTheRest) {
  const auto all = replies(
      "3 jog arm1 motors 0 0 0 0 0 4 speed 0.2 acceleration 0.2\n"
      "150 move arm1 joints 0.1 -1.5 0 1.5 1.57 -1.57\n"
      "200 end\n",
      "arm1", {});
  EXPECT_NEAR(all.at(140).motors[5] - all.at(3).motors[5], 4, 0.05);
  EXPECT_EQ(all.at(140).state, DriverState::not_synchronised);
  EXPECT_NEAR(all.at(195).motors[5], all.at(140).motors[5], 0.05);
}

TEST_F(Manual, StopEndsAMotionAndTheArmHolds) {
  const auto all = replies(
      "3 home arm1\n"
      "100 move arm1 joints 1 -1.57 0 1.56 1.57 -1.57 speed 0.3 acceleration 0.2\n"
      "140 stop arm1\n"
      "260 end\n");
  EXPECT_GT(all.at(145).joints[0], 0.01);
  EXPECT_LT(last(all).joints[0], 0.9);
  EXPECT_NEAR(all.at(200).joints[0], last(all).joints[0], 1e-3);
  EXPECT_EQ(last(all).state, DriverState::holding);
}

TEST_F(Manual, ADriverThatTripsIsToldOfWithItsBlackBoxAndTheSessionGoesOn) {
  const auto all = replies(
      "3 home all\n"
      "100 move arm1 joints 0.5 -1.57 0 1.56 1.57 -1.57 speed 0.05\n"
      "240 jog arm2 joints 0 0.05 0 0 0 0 0 speed 0.5 acceleration 0.2\n"
      "400 end\n",
      "arm2",
      words({kKnown,
             {"--set", "robots.arm1.force_fault=\"silent\"", "--set", "robots.arm1.force_fault_step=2000"}}));
  EXPECT_NEAR(last(all).joints[1] - all.at(235).joints[1], 0.05, 2e-3) << "the other arm goes on";
  const auto told = summary(run_);
  EXPECT_EQ(told.at("outcome"), "done");
  ASSERT_EQ(told.at("survived").size(), 1U) << told.dump(2);
  EXPECT_EQ(told.at("survived").at(0).at("code"), "sensor_silent");
  EXPECT_EQ(told.at("survived").at(0).at("process"), "edp-arm1");
  EXPECT_NEAR(told.at("survived").at(0).at("sim_s").get<double>(), 4, 0.2);
  int steps = 0, drivers = 0;
  for (const std::string file : told.at("black_box")) {
    EXPECT_GT(fs::file_size(run_ / file), 0U) << file;
    steps += file.starts_with("arm1-fault-");
    drivers += file.starts_with("black_box/edp-arm1-") && file.ends_with("/edp-arm1.txt");
  }
  EXPECT_EQ(steps, 1);
  EXPECT_EQ(drivers, 1);
  std::ifstream log(run_ / "messages.log");
  const std::string text(std::istreambuf_iterator<char>(log), {});
  EXPECT_NE(text.find("`ui_cli manual reset arm1`"), std::string::npos) << text;
  const Ended checked = run(folder_, "ui_cli", {"log", "check", run_.string()});
  EXPECT_EQ(checked.status, 0) << checked.all();
}

TEST_F(Manual, ATerminalIsAnsweredWhenItIsDoneOrWhyNot) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  Started task(folder_, "manual",
               words({{"--session", "hand", "--run-dir", (folder_ / "run").string()}, kKnown}));
  ASSERT_TRUE(task.await_line("session hand"));
  const auto manual = [&](const std::vector<std::string>& instruction) {
    return run(folder_, "ui_cli", words({{"manual", "--session", "hand"}, instruction}));
  };
  Ended homed = manual({"home", "arm1"});
  EXPECT_EQ(homed.status, 0) << homed.all();
  EXPECT_EQ(manual({"jog", "arm1", "joints", "-0.02", "0", "0", "0", "0", "0", "speed", "0.5"}).status, 0);
  const Ended unreachable = manual({"move", "arm1", "angle-axis", "5", "0", "1", "0", "0", "0"});
  EXPECT_EQ(unreachable.status, 1);
  EXPECT_NE(unreachable.last_err().find("failed: arm1"), std::string::npos) << unreachable.all();
  EXPECT_EQ(manual({"dance", "arm1"}).status, 2);
  const Ended jaws = manual({"gripper", "arm1", "0.06"});
  EXPECT_EQ(jaws.status, 2);
  EXPECT_NE(jaws.last_err().find("arm1 has no gripper"), std::string::npos) << jaws.all();
  const Ended trigger = run(folder_, "ui_cli", {"--session", "hand", "trigger"});
  EXPECT_EQ(trigger.status, 1);
  EXPECT_NE(trigger.last_err().find("does not wait for a trigger"), std::string::npos) << trigger.all();
  EXPECT_EQ(manual({"show", "arm3"}).status, 2);
  EXPECT_EQ(manual({"show", "arm1"}).status, 0);
  EXPECT_EQ(manual({"end"}).status, 0);
  EXPECT_EQ(task.end().status, 0);
  const auto times = summary(folder_ / "run");
  EXPECT_GT(times.at("wall_s").get<double>(), 0.9 * times.at("sim_s").get<double>())
      << "who uses hands has time";
}

TEST_F(Manual, EndsWhileItIsPaused) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  Started task(folder_, "manual",
               words({{"--session", "paused_hand", "--run-dir", (folder_ / "run").string()}, kKnown}));
  ASSERT_TRUE(task.await_line("session paused_hand"));
  const auto ui = [&](const std::vector<std::string>& order) {
    return run(folder_, "ui_cli", words({{"--session", "paused_hand"}, order})).status;
  };
  EXPECT_EQ(ui({"manual", "home", "arm1"}), 0);
  EXPECT_EQ(ui({"pause"}), 0);
  EXPECT_EQ(ui({"manual", "end"}), 0);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 0) << ended.all();
}

}  // namespace
}  // namespace mrroc::test
