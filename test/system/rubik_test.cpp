// The task of the cube as a user starts it: one turn, several processes, what is refused.
#include <gtest/gtest.h>

#include <sstream>

#include "test/system/cube_run.hpp"

namespace mrroc::test {
namespace {

const std::string kMovesHeading =
    "k,turn,t_start,t_end,attempts,tool_deg,face_deg,behind_deg,slip_mm,force_peak_N,torque_peak_Nm,"
    "force_std_N";

/// What every process decided follows from the log, to its end.
void expect_recomputed(const CubeRun& r) {
  const Ended checked = run(r.folder, "ui_cli", {"log", "check", (r.folder / "run").string(), "--json"});
  std::string text;
  for (const std::string& line : checked.out) text += line + "\n";
  const auto verdict = nlohmann::json::parse(text, nullptr, false);
  ASSERT_TRUE(verdict.is_object()) << checked.all();
  EXPECT_EQ(checked.status, 0);
  EXPECT_EQ(verdict.at("differences"), 0) << verdict.dump(2);
  EXPECT_EQ(verdict.at("complete"), true) << verdict.dump(2);
  for (const auto& p : verdict.at("processes"))
    if (p.at("process") == "mp" || p.at("process").get<std::string>().starts_with("ecp-")) {
      EXPECT_EQ(p.at("not_checked"), "") << p.at("process");
      EXPECT_GT(p.at("compared").get<int>(), 300) << p.at("process");
    }
}

TEST(Rubik, TurnsAFaceAndTheCubeIsSolved) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const CubeRun r({"--processes", "one"});
  ASSERT_EQ(r.ended.status, 0) << r.ended.all();
  EXPECT_EQ(r.left.told.at("outcome"), "done");
  EXPECT_EQ(r.figure("solved"), 1);
  EXPECT_EQ(r.figure("moves"), 1);
  EXPECT_NE(r.left.text("cube_start.txt"), r.left.text("cube_end.txt"));
  EXPECT_NEAR(r.figure("approach_settled_N"), 4, 0.2);
  EXPECT_LE(r.figure("turn_lateral_peak_N"), 12);
  EXPECT_LE(r.figure("turn_angle_err_deg"), 2);
  EXPECT_TRUE(r.said("N across, ")) << "forces of the turn are told";
  EXPECT_LE(r.figure("turn_slip_mm"), 2);
  EXPECT_LT(r.figure("squeeze_N"), 450) << "not crushed";
  std::istringstream moves(r.left.text("moves.csv"));
  std::string heading, row;
  std::getline(moves, heading);
  std::getline(moves, row);
  EXPECT_EQ(heading, kMovesHeading);
  EXPECT_TRUE(row.starts_with("1,U,")) << row;
  for (const char* picture : {"fig16_approach.png", "fig17_turn.png", "turns.png"})
    EXPECT_TRUE(std::filesystem::exists(r.folder / "run" / "plots" / picture)) << picture;
  expect_recomputed(r);
}

TEST(Rubik, IsTheSameWhateverCarriesItsMessages) {
  if (kSanitized || !multicast()) GTEST_SKIP() << (kSanitized ? "too long" : "no multicast");
  const CubeRun one({"--processes", "one"});
  const CubeRun separate({"--processes", "separate"});
  ASSERT_EQ(one.ended.status, 0) << one.ended.all();
  ASSERT_EQ(separate.ended.status, 0) << separate.ended.all();
  EXPECT_EQ(one.left.told.at("log_hash"), separate.left.told.at("log_hash"));
  EXPECT_EQ(one.left.text("arm2.csv"), separate.left.text("arm2.csv"));
}

TEST(Rubik, RefusesWhatItCannotDoBeforeAnythingStarts) {
  Folder folder;
  for (const auto& [arguments, word] :
       {std::pair{words({{"--scramble", "R Q"}}), "Q"},
        {words({{"--state", "UUU"}}), "54"},
        {words({{"--scramble", "R", "--set", "task.torqe=3"}}), "torqe"},
        {words({{"--scramble", "R", "--set", "cube.held_by=arm3"}}), "arm3"},
        {words({{"--scramble", "R", "--set", "cube.held_by=arm1"}}), "arm2 holds the cube"},
        {words({{"--scramble", "R", "--set", "sim.cube.place_error.y=0.002"}}), "from jaw to jaw"}}) {
    const Ended ended = run(folder, "rubik", arguments);
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.last_err().find(word), std::string::npos) << ended.last_err();
  }
}

}  // namespace
}  // namespace mrroc::test
