// The visual servoing task as a user starts it, with real renderings of the simulated scene.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {
namespace {

const std::string kServoHeading =
    "k,t,behaviour,sac_seen,eih_seen,err_x,err_y,err_z,err_angle,true_err_mm,true_err_deg";
/// Column of servo.csv.
constexpr int kBehaviour = 2;

/// Without smooth edges and shadows: fast enough for tests of what is done with pictures, not of how good they are.
const std::vector<std::string> kFast{"--processes", "one", "--set", "cameras.profile=fast"};

struct ServoRun {
  explicit ServoRun(const std::vector<std::string>& arguments, const std::string& name = "run")
      : ended(run(folder, "visual_servo", words({arguments, {"--run-dir", (folder / name).string()}}))) {
    if (std::filesystem::exists(folder / name / "servo.csv"))
      table = read_table(folder / name / "servo.csv", kServoHeading);
    if (std::filesystem::exists(folder / name / "summary.json")) told = summary(folder / name);
  }
  [[nodiscard]] double figure(const std::string& key) const { return test::figure(told, key); }
  [[nodiscard]] std::vector<double> behaviours() const {
    std::vector<double> order;
    for (const Row& row : table)
      if (order.empty() || order.back() != row[kBehaviour]) order.push_back(row[kBehaviour]);
    return order;
  }

  Folder folder;
  Ended ended;
  std::vector<Row> table;
  nlohmann::json told;
};

TEST(VisualServo, BringsTheToolToTheObjectAsInFig28) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const ServoRun r({"--processes", "one"});
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_EQ(r.told.at("outcome"), "done");
  EXPECT_LE(r.figure("final_err_mm"), 1);
  EXPECT_LE(r.figure("final_err_deg"), 0.1);
  EXPECT_LE(r.figure("overshoot_pct"), 10);
  EXPECT_LE(r.figure("steps_to_2mm"), 80);
  const auto order = r.behaviours();
  ASSERT_GE(order.size(), 3u);
  EXPECT_EQ(order.front(), 1) << "first the SAC alone";
  EXPECT_EQ(order.back(), 2) << "in the end the arm hides the object from the SAC";
  EXPECT_NE(std::ranges::find(order, 3), order.end()) << "and both in between";
  for (const char* picture : {"error.png", "true_error.png"})
    EXPECT_TRUE(std::filesystem::exists(r.folder / "run" / "plots" / picture)) << picture;
}

TEST(VisualServo, ReachesTheObjectWithEveryAggregation) {
  if (kSanitized) GTEST_SKIP() << "too long";
  for (const std::string method : {"mean", "switching", "weights"}) {
    const ServoRun r(words({kFast, {"--aggregation", method}}));
    ASSERT_EQ(r.ended.status, 0) << r.ended.all();
    EXPECT_LE(r.figure("steps_to_2mm"), 80) << method;
    EXPECT_LE(r.figure("overshoot_pct"), 10) << method;
  }
}

TEST(VisualServo, FollowsAnObjectOnALine) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const ServoRun r(words({kFast, {"--scenario", "line"}}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_LE(std::abs(r.figure("line_lag_mm")), 10);
  EXPECT_LE(r.figure("follow_err_mm"), 10);
}

TEST(VisualServo, FollowsAnObjectThatGoesInACircleOrIsMovedByHand) {
  if (kSanitized) GTEST_SKIP() << "too long";
  for (const std::string scenario : {"circle", "hand"}) {
    const ServoRun r(words({kFast, {"--scenario", scenario}}));
    ASSERT_EQ(r.ended.status, 0) << r.ended.all();
    EXPECT_LE(r.figure("follow_err_mm"), 10) << scenario;
  }
}

TEST(VisualServo, ReachesATagWithEitherCameraAloneAndLeavesTheirPictures) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const auto settings = words({kFast, {"--object", "apriltag"}});
  const ServoRun sac(words({settings, {"--cameras", "sac", "--set", "task.duration=6"}}));
  ASSERT_EQ(sac.ended.status, 0) << sac.ended.all();
  for (const double m : sac.behaviours())
    EXPECT_TRUE(m <= 1 || m == 4) << m << ": PB-SAC, from memory, or idle";
  EXPECT_TRUE(std::filesystem::exists(sac.folder / "run" / "sac_tag.png"));
  EXPECT_FALSE(std::filesystem::exists(sac.folder / "run" / "eih_tag.png"));
  const ServoRun both(settings);
  ASSERT_EQ(both.ended.status, 0) << both.ended.all();
  EXPECT_LE(both.figure("final_err_mm"), 2);
  EXPECT_LE(both.figure("steps_to_2mm"), 80);
}

TEST(VisualServo, LooksForTheBoardThatTheConfigurationDescribes) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const ServoRun r(words({kFast, {"--set", "chessboard.columns=7", "--set", "chessboard.square=0.023"}}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_LE(r.figure("final_err_mm"), 1);
}

TEST(VisualServo, HoldsWhileTheObjectIsHiddenAndGoesOn) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const ServoRun r(words({kFast, {"--scenario", "occluded"}}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  const auto order = r.behaviours();
  EXPECT_NE(std::ranges::find(order, 0), order.end());
  EXPECT_LE(r.figure("final_err_mm"), 2);
}

TEST(VisualServo, WaitsForAnObjectThatIsAbsentAtFirst) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const ServoRun r(words({kFast, {"--scenario", "absent"}}));
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_EQ(r.behaviours().front(), 0);
  EXPECT_LE(r.figure("final_err_mm"), 2);
}

TEST(VisualServo, NeverMovesForAWrongBoardAndIsGivenUp) {
  for (const std::string object : {"chessboard", "apriltag"}) {
    const ServoRun r(words({kFast, {"--scenario", "wrong_board", "--object", object}}));
    EXPECT_EQ(r.ended.status, 1) << r.ended.all();
    EXPECT_TRUE(r.ended.last_err().starts_with("error: object_not_seen: ")) << r.ended.last_err();
    EXPECT_EQ(r.told.at("fault").at("code"), "object_not_seen");
    EXPECT_EQ(r.behaviours(), std::vector<double>{0});
    EXPECT_LT(r.figure("arm_moved_mm"), 0.5);
  }
}

TEST(VisualServo, IsTheSameEveryTimeWhateverCarriesItsMessages) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const std::vector<std::string> brief{"--set", "cameras.profile=fast", "--set", "task.duration=2"};
  const ServoRun one(words({brief, {"--processes", "one"}}));
  ASSERT_EQ(one.ended.status, 0) << one.ended.all();
  const ServoRun again(words({brief, {"--processes", multicast() ? "separate" : "one"}}));
  ASSERT_EQ(again.ended.status, 0) << again.ended.all();
  EXPECT_EQ(one.told.at("log_hash"), again.told.at("log_hash"));
  const auto text = [](const ServoRun& r) {
    std::ifstream file(r.folder / "run" / "servo.csv");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(text(one), text(again));
}

TEST(VisualServo, RefusesWhatItCannotDoBeforeAnythingStarts) {
  for (const auto& [arguments, word] : {std::pair{words({{"--scenario", "dance"}}), "dance"},
                                        {words({{"--set", "cameras.sac.mount=world"}}), "mount"},
                                        {words({{"--set", "task.desired=[1]"}}), "task.desired"},
                                        {words({{"--set", "task.sped=1"}}), "sped"}}) {
    const ServoRun r(arguments);
    EXPECT_EQ(r.ended.status, 2) << r.ended.all();
    EXPECT_NE(r.ended.last_err().find(word), std::string::npos) << r.ended.last_err();
  }
}

}  // namespace
}  // namespace mrroc::test
