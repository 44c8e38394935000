// Failures of the cube's task, by contact in the simulation: each ends in recovery or in its own fault,
// with both arms at rest and a cube that is not crushed.
#include <gtest/gtest.h>
#include <csignal>

#include <thread>

#include "tasks/rubik/figure_info.hpp"
#include "test/system/cube_run.hpp"

namespace mrroc::test {
namespace {

constexpr double kRest = 1e-3;      // speed of a hand at rest [m/s]
constexpr double kTorqueMost = 10;  // about the axis of a turn, the end of the sensor's range [N m]

std::vector<std::string> set(std::initializer_list<const char*> settings) {
  std::vector<std::string> arguments{"--processes", "one"};
  for (const char* setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return arguments;
}

void expect_fault(const CubeRun& r, const std::string& code) {
  EXPECT_EQ(r.ended.status, 1) << r.ended.all();
  EXPECT_EQ(r.left.fault(), code) << r.ended.all();
  EXPECT_EQ(r.figure("solved"), 0);
  EXPECT_LT(r.left.speed_at_the_end(), kRest) << "both arms are at rest";
  EXPECT_LT(r.figure("squeeze_N"), rubik::kMostSqueeze) << "not crushed";
}

class RubikErrors : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
  }
};

TEST_F(RubikErrors, AFaceThatJamsClockwiseIsTurnedByThreeQuartersTheOtherWay) {
  const CubeRun r(
      set({"sim.cube.jam=20", "cube.seed=7", "sim.cube.jam_direction=clockwise", "task.attempts=2"}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_TRUE(r.said("U jams clockwise: it will be turned the other way round")) << r.ended.all();
  EXPECT_EQ(r.figure("solved"), 1);
  EXPECT_EQ(r.figure("moves"), 1);
  EXPECT_EQ(r.figure("other_way"), 1);
  EXPECT_EQ(r.figure("retries"), 2);
  EXPECT_LT(r.figure("squeeze_N"), rubik::kMostSqueeze);
  EXPECT_LT(r.figure("turn_torque_peak_Nm"), kTorqueMost);
}

TEST_F(RubikErrors, AFaceThatGivesWayAtALaterAttemptIsTurned) {
  const CubeRun r(set({"sim.cube.jam=10", "cube.seed=7", "sim.cube.jam_loosening=0.6"}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_TRUE(r.said("turned at attempt 2")) << r.ended.all();
  EXPECT_EQ(r.figure("solved"), 1);
  EXPECT_EQ(r.figure("retries"), 1);
  EXPECT_EQ(r.figure("other_way"), 0);
  EXPECT_LT(r.figure("squeeze_N"), rubik::kMostSqueeze);
}

TEST_F(RubikErrors, FacesTwiceAsTightAreTurnedAtTheFirstTry) {
  const CubeRun r(set({"sim.cube.face_friction_scale=2"}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_EQ(r.figure("solved"), 1);
  EXPECT_EQ(r.figure("retries"), 0);
  EXPECT_GT(r.figure("turn_torque_peak_Nm"), 5) << "more than the usual sensor measures";
  EXPECT_LT(r.figure("turn_torque_peak_Nm"), kTorqueMost);
  EXPECT_LT(r.figure("squeeze_N"), rubik::kMostSqueeze);
}

TEST_F(RubikErrors, ACubeOfAnotherSizeIsHeldAndTakenOver) {
  for (const char* error : {"sim.cube.size_error=-0.0003", "sim.cube.size_error=0.0003"}) {
    const CubeRun r(set({error}), {"--scramble", "R", "--eyes", "none", "--set", "task.tables=small"});
    ASSERT_EQ(r.ended.status, 0) << r.ended.all();
    EXPECT_EQ(r.figure("solved"), 1);
    EXPECT_EQ(r.figure("regrasps"), 1) << "the other hand takes it";
    EXPECT_EQ(r.figure("retries"), 0);
    EXPECT_LT(r.figure("squeeze_N"), rubik::kMostSqueeze);
  }
}

TEST_F(RubikErrors, ABaseThatIsAFewMillimetresOffIsNoMatterForOpenJaws) {
  const CubeRun r(set({"sim.robots.arm1.base_error.z=0.003"}),
                  {"--scramble", "R", "--eyes", "none", "--set", "task.tables=small"});
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_EQ(r.figure("solved"), 1);
  EXPECT_EQ(r.figure("retries"), 0);
}

TEST_F(RubikErrors, ABaseThatIsElsewhereThanBelievedIsToldAndNotAdaptedTo) {
  constexpr const char* kTruth = "sim.robots.arm2.place=[0.045, 0, 0, 0, 0, 0]";
  const CubeRun wrong(set({kTruth}));
  EXPECT_EQ(wrong.ended.status, 1) << wrong.ended.all();
  EXPECT_EQ(wrong.left.fault(), "cube_slipped")
      << "the cube is not where the hand comes to it: " << wrong.ended.all();
  EXPECT_EQ(wrong.figure("solved"), 0);
  // The tables end with the fault; the supervisor has waited for rest.
  EXPECT_GT(wrong.figure("stop_steps_max"), 0) << "the arms came to rest";
  const CubeRun corrected(set({kTruth, "cell.robots.arm2.place=[0.045, 0, 0, 0, 0, 0]"}));
  EXPECT_EQ(corrected.ended.status, 0) << corrected.ended.all();
  EXPECT_EQ(corrected.figure("solved"), 1);
}

TEST_F(RubikErrors, AFaceThatJamsInBothDirectionsIsAFault) {
  const CubeRun r(set({"sim.cube.jam=20", "cube.seed=7", "task.attempts=1"}));
  expect_fault(r, "face_jammed");
  EXPECT_EQ(r.figure("other_way"), 1);
  EXPECT_LT(r.figure("turn_torque_peak_Nm"), kTorqueMost);
}

TEST_F(RubikErrors, AFaceThatDoesNotLeaveItsSeatIsAFault) {
  const CubeRun r(set({"sim.cube.breakaway=30", "task.attempts=2"}));
  expect_fault(r, "face_jammed");
  EXPECT_LT(r.figure("turn_torque_peak_Nm"), kTorqueMost);
}

TEST_F(RubikErrors, ACubeThatIsBesideThePalmIsPassedByAndNotGripped) {
  expect_fault(CubeRun(set({"sim.cube.place_error.x=0.045"})), "cube_slipped");
}

TEST_F(RubikErrors, ACubeThatHasSlippedOutOfThePalmIsNotGripped) {
  expect_fault(CubeRun(set({"sim.cube.place_error.z=0.007"})), "cube_slipped");
}

TEST_F(RubikErrors, ACubeThatSlidesOutOfItsHandIsNamedAsDropped) {
  expect_fault(CubeRun(set({"sim.cube.friction=0.0005"})), "cube_dropped");
}

TEST_F(RubikErrors, AnImpossibleCubeIsReadTwiceAndIsAFault) {
  const CubeRun r(set({"cube.twist=1"}), {"--scramble", "U'", "--set", "task.tables=small"});
  expect_fault(r, "cube_misread");
  EXPECT_TRUE(r.said("twist")) << r.ended.all();
}

TEST_F(RubikErrors, FacesThatMirrorALampAreShownAgainTiltedAndTheCubeIsSolved) {
  const CubeRun r(set({"cameras.light.direction=[0.883, 0.321, 0.342]", "cameras.light.lamp=[1.2, 1.2, 1.2]",
                       "cameras.light.exposure=0.6"}),
                  {"--scramble", "U'", "--set", "task.tables=small"});
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_TRUE(r.said("are not certain")) << "the lamp stands behind the camera: " << r.ended.all();
  EXPECT_TRUE(r.said("all faces are shown once more")) << r.ended.all();
  EXPECT_FALSE(r.said("not seen well")) << r.ended.all();
  EXPECT_EQ(r.figure("solved"), 1);
  EXPECT_EQ(r.figure("verified"), 1);
}

class RubikDeaths : public RubikErrors {
 protected:
  void SetUp() override {
    RubikErrors::SetUp();
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }
  std::vector<std::string> separate(const std::vector<std::string>& turns) {
    return words({turns, {"--processes", "separate", "--run-dir", (folder / "run").string()}});
  }
  /// Waits until the coordinator is in a behaviour. @return whether it was
  bool await_behaviour(const std::string& name) {
    for (int k = 0; k < 2000; ++k) {
      std::string text;
      for (const auto& line : test::run(folder, "ui_cli", {"status", "--json"}).out) text += line;
      const auto status = nlohmann::json::parse(text, nullptr, false);
      if (status.is_object() && status.value("behaviour", nlohmann::json()) == name) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }
  void expect_death(Started& task, const std::string& part, int signal, const std::string& code) {
    const ProcessId victim = task.child(part);
    const auto children = task.children();
    ::kill(victim.pid, signal);
    const Ended ended = task.end();
    EXPECT_EQ(ended.status, 3) << ended.all();
    EXPECT_TRUE(all_gone(children));
    const CubeFigures left(folder / "run");
    EXPECT_EQ(left.fault(), code) << ended.all();
    EXPECT_EQ(left.told.at("fault").at("process"), part);
    EXPECT_LE(left.figure("stop_steps_max"), 100);
    EXPECT_LT(left.figure("squeeze_N"), rubik::kMostSqueeze);
  }

  Folder folder;
};

TEST_F(RubikDeaths, AnArmsProcessThatIsKilledInATurnBringsBothArmsToRest) {
  for (const char* part : {"ecp-arm2", "edp-arm1"}) {
    Started task(folder, "rubik", separate(kOneTurn), part);
    ASSERT_TRUE(task.await_line("move 1 of 1"));
    ASSERT_TRUE(await_behaviour("turn"));
    expect_death(task, part, SIGKILL, "process_died");
    std::filesystem::remove_all(folder / "run");
  }
}

TEST_F(RubikDeaths, ACameraThatDiesOrIsSilentIsAFaultWithBothArmsAtRest) {
  for (const int signal : {SIGKILL, SIGSTOP}) {
    Started task(folder, "rubik", separate({"--scramble", "U'", "--set", "task.tables=small"}),
                 std::to_string(signal));
    ASSERT_TRUE(task.await_line("show "));
    expect_death(task, "vsp-cube", signal, signal == SIGKILL ? "process_died" : "process_hung");
    std::filesystem::remove_all(folder / "run");
  }
}

}  // namespace
}  // namespace mrroc::test
