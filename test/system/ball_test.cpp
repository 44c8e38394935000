// The task ball as a user starts it: what it must reach, that it refuses in time, that it fails safely, and that it obeys.
#include <gtest/gtest.h>

#include <csignal>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

Ended run_ball(const Folder& folder, const std::vector<std::string>& arguments) {
  return run(folder, "ball",
             words({{"--processes", "one", "--run-dir", (folder / "run").string()}, arguments}));
}

/// A run that has come to its end. @return its summary
nlohmann::json carried(const Folder& folder, const std::vector<std::string>& arguments) {
  const Ended ended = run_ball(folder, arguments);
  EXPECT_EQ(ended.status, 0) << ended.all();
  auto s = summary((folder / "run").string());
  EXPECT_EQ(s.at("outcome"), "done");
  return s;
}

class BallObjects : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(BallObjects, AreCarriedAroundTheCircleWithTheInnerForce) {
  const Folder folder;
  const auto s = carried(folder, GetParam());
  EXPECT_NEAR(figure(s, "inner_force_N"), 12.5, 0.5);
  EXPECT_LE(figure(s, "circle_rms_mm"), 2);
  EXPECT_EQ(figure(s, "falls"), 0);
  EXPECT_LT(figure(s, "inner_force_peak_N"), 20) << "it is not crushed";
  EXPECT_LT(figure(s, "turned_deg"), 10);
}

using Words = std::vector<std::string>;
INSTANTIATE_TEST_SUITE_P(
    All, BallObjects,
    testing::Values(Words{"--object", "ball"}, Words{"--object", "box"},
                    Words{"--set", "sim.free_body.mass=1", "--set", "sim.free_body.friction=0.6"},
                    Words{"--object", "box", "--set", "sim.free_body.size=0.18", "--set",
                          "sim.palm.stiffness=3000", "--set", "sim.free_body.offset=[0.01, 0.008, 0]"}));

/// A push of one arm [N].
struct Push {
  const char *arm, *force;
};

TEST(Ball, YieldsToAHandThatPushesOneArmAndKeepsTheObject) {
  for (const Push& push : {Push{"arm1", "[8, 6, 0]"}, Push{"arm1", "[0, -8, 0]"}, Push{"arm1", "[-6, 4, 5]"},
                           Push{"arm2", "[-8, 0, 6]"}}) {
    SCOPED_TRACE(std::string(push.arm) + " " + push.force);
    const Folder folder;
    const auto s = carried(folder, {"--hand", "--set", std::string("hand.force=") + push.force, "--set",
                                    std::string("hand.arm=") + push.arm});
    EXPECT_GT(figure(s, "yielded_mm"), 10);
    EXPECT_NEAR(figure(s, "inner_force_N"), 12.5, 0.5);
    EXPECT_EQ(figure(s, "falls"), 0);
  }
}

TEST(Ball, RefusesWhatTheForceCannotHoldBeforeAnythingMoves) {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    const Ended ended = run_ball(folder, arguments);
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.last_err().find(why), std::string::npos) << ended.all();
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  };
  refused({"--set", "free_body.mass=3"}, "cannot be held by 12.5 N");
  refused({"--set", "free_body.friction=0.1"}, "would slide");
  refused({"--set", "task.force=30"}, "would crush");
  refused({"--set", "free_body.pedestal=[0.3, 1.05, 1.3]"}, "arm");
  refused({"--object", "egg"}, "--object");
  refused({"--set", "free_body.shape=none"}, "nothing to carry");
}

/// A run that ends with a fault. @return its error
std::string failed(const Folder& folder, const std::vector<std::string>& arguments) {
  const Ended ended = run_ball(folder, arguments);
  EXPECT_EQ(ended.status, 1) << ended.all();
  const auto s = summary((folder / "run").string());
  EXPECT_LE(s.at("figures").at("stop_steps_max").get<double>(), 100);
  return ended.last_err();
}

TEST(Ball, PutsDownWhatIsHeavierThanItIsTold) {
  const Folder folder;
  EXPECT_NE(failed(folder, {"--set", "sim.free_body.mass=1.8"}).find("object_too_heavy"), std::string::npos);
}

TEST(Ball, FeelsThatThereIsNoObjectOrOneOfAnotherSize) {
  const Folder nothing, small;
  EXPECT_NE(
      failed(nothing, {"--set", "sim.free_body.offset=[0, 0, -0.1]", "--set", "sim.free_body.size=0.06"})
          .find("do not both touch the object of 200 mm); set free_body.size"),
      std::string::npos);
  EXPECT_NE(failed(small, {"--set", "sim.free_body.size=0.25"}).find("object_not_as_told"),
            std::string::npos);
}

TEST(Ball, RefusesAnObjectThatWouldBeginInsideThePalms) {
  const Folder folder;
  const Ended ended = run_ball(folder, {"--object", "box", "--set", "sim.free_body.size=0.4"});
  EXPECT_EQ(ended.status, 2) << ended.all();
  EXPECT_NE(ended.last_err().find("sim.free_body.size: 0.4 m do not fit between the palms"),
            std::string::npos)
      << ended.all();
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

TEST(Ball, StopsWhenTheObjectSlipsOutOrIsCrushed) {
  const Folder slips, crushed;
  EXPECT_NE(failed(slips, {"--set", "sim.free_body.friction=0.1"}).find("object_lost"), std::string::npos);
  EXPECT_NE(failed(crushed, {"--hand", "--set", "hand.force=[0, -30, 0]", "--set", "task.most_force=15"})
                .find("object_crushed"),
            std::string::npos);
}

TEST(Ball, IsRepeatedBitForBitAndCheckedFromItsLog) {
  const Folder folder;
  const Words shortly{"--set", "task.turn=400"};
  const auto hash = carried(folder, shortly)["log_hash"];
  const Ended checked = run(folder, "ui_cli", {"log", "check", (folder / "run").string()});
  EXPECT_EQ(checked.status, 0) << checked.all();
  std::filesystem::rename(folder / "run", folder / "first");
  EXPECT_EQ(carried(folder, shortly)["log_hash"], hash);
}

TEST(Ball, StopsAndHoldsTheObjectAsEveryTaskStops) {
  const Folder folder;
  const std::string orders = folder.write("orders", "3 start\n800 stop\n");
  const Ended ended = run_ball(folder, {"--script", orders});
  EXPECT_EQ(ended.status, 1) << ended.all();
  const auto s = summary((folder / "run").string());
  EXPECT_EQ(s.at("outcome"), "stopped");
  EXPECT_LE(s.at("figures").at("stop_steps_max").get<double>(), 100);
  EXPECT_EQ(figure(s, "falls"), 0);
}

TEST(Ball, KeepsTheInnerForceInAPause) {
  const Folder folder;
  const std::string orders = folder.write("orders", "3 start\n800 pause\n1000 resume\n");
  const auto s = carried(folder, {"--script", orders});
  EXPECT_NEAR(figure(s, "inner_force_N"), 12.5, 0.5);
  EXPECT_LE(figure(s, "circle_rms_mm"), 2);
}

TEST(Ball, BrakesWhenAControlSubsystemDiesWhileTheObjectIsCarried) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder(false);
  Started ball(folder, "ball", {"--speed", "4", "--run-dir", (folder / "run").string()});
  ASSERT_TRUE(ball.await_line("around"));
  const auto children = ball.children();
  ::kill(ball.child("ecp-arm2").pid, SIGKILL);
  const Ended ended = ball.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(all_gone(children));
}

}  // namespace
}  // namespace mrroc::test
