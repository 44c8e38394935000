// The task guide as a user starts it: what it must reach on every fixture, that it refuses in time, and that it obeys.
#include <gtest/gtest.h>

#include <csignal>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

const std::string kSvg =
    "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 C40 -60 60 -60 100 0 L100 50 L60 50'/></svg>";

/// A run that has come to its end. @return its summary
nlohmann::json led(const Folder& folder, const std::vector<std::string>& arguments) {
  const std::string run_folder = (folder / "run").string();
  const Ended ended =
      run(folder, "guide", words({{"--processes", "one", "--run-dir", run_folder}, arguments}));
  EXPECT_EQ(ended.status, 0) << ended.all();
  auto s = summary(run_folder);
  EXPECT_EQ(s.at("outcome"), "done");
  return s;
}

class GuideFixtures : public testing::TestWithParam<std::string> {};

TEST_P(GuideFixtures, HoldTheToolAgainstTenNewtonsAndLetItGoAlong) {
  const Folder folder;
  const std::string fixture = GetParam() == "svg" ? folder.write("curve.svg", kSvg) : GetParam();
  const auto s = led(folder, {"--fixture", fixture});
  EXPECT_GT(figure(s, "across_force_N"), 9) << "the hand pushes";
  EXPECT_LE(figure(s, "fixture_dev_mm"), 1);
  EXPECT_NEAR(figure(s, "compliance_mm_per_10N"), 0.5, 0.15) << "20 N/mm";
  EXPECT_LE(figure(s, "fixture_drag_N"), 2);
  EXPECT_GT(figure(s, "fixture_drag_N"), 0.3) << "it moves";
  EXPECT_LE(figure(s, "entry_step_mm"), 0.15);
  EXPECT_GE(figure(s, "least_energy_mJ"), -1);
  if (GetParam() == "circle") return;
  EXPECT_GT(figure(s, "wall_force_N"), 10) << "and its ends are felt";
  EXPECT_LT(figure(s, "wall_depth_mm"), 8);
}

TEST(Guide, HoldsInNarrowBendsAgainstAHandThatPushesThereToo) {
  const Folder folder;
  const auto s = led(folder, {"--set", "task.fixture=curve", "--set",
                              "task.curve=[-45,0,-20,30,0,0,20,-30,45,0,20,30,0,0,-20,-30,-45,0]", "--set",
                              "sim.hand.stiffness=800", "--set", "sim.hand.damping=20", "--set",
                              "sim.hand.mass=0", "--set", "sim.hand.tremor=0.001"});
  EXPECT_GT(figure(s, "across_force_N"), 9);
  EXPECT_LE(figure(s, "fixture_dev_mm"), 1);
  EXPECT_LE(figure(s, "fixture_drag_N"), 2);
  EXPECT_GE(figure(s, "least_energy_mJ"), -1);
}

TEST(Guide, HoldsAHandInAZigzagOfSharpCorners) {
  const Folder folder;
  const auto s =
      led(folder,
          {"--set", "task.fixture=curve", "--set",
           "task.curve=[-45,-10,-30,10,-15,-10,0,10,15,-10,30,10,45,-10]"});  // 74 degrees between its sides
  EXPECT_GT(figure(s, "across_force_N"), 9);
  EXPECT_LE(figure(s, "fixture_dev_mm"), 1);
  EXPECT_LE(figure(s, "fixture_drag_N"), 2);
  EXPECT_GE(figure(s, "least_energy_mJ"), -1);
}

INSTANTIATE_TEST_SUITE_P(All, GuideFixtures, testing::Values("line", "plane", "circle", "svg"));

TEST(Guide, IsRepeatedFromTheConfigurationOfARunWithoutTheFileOfItsCurve) {
  const Folder folder;
  const std::string file = folder.write("curve.svg", kSvg);
  const auto hash = led(folder, {"--fixture", file})["log_hash"];
  std::filesystem::rename(folder / "run", folder / "first");
  std::filesystem::remove(file);
  EXPECT_EQ(led(folder, {"--config", (folder / "first" / "config.toml").string()})["log_hash"], hash);
}

TEST(Guide, SaysThatThereIsNothingToDrawOfARunThatNeverCameToTheFixture) {
  const Folder folder;
  const Ended ended = run(folder, "guide",
                          {"--processes", "one", "--run-dir", (folder / "run").string(), "--script",
                           folder.write("orders", "3 start\n150 stop\n")});
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_NE(ended.all().find("no pictures: the run ended before there was anything to draw"),
            std::string::npos)
      << ended.all();
  EXPECT_EQ(ended.all().find("gnuplot"), std::string::npos) << ended.all();
}

TEST(Guide, IsRepeatedByMoveAsPosesOfOneToolThoughTheFixtureTurnsItsFrame) {
  const Folder folder;
  led(folder, {});
  const auto again = [&](const std::string& keys) {
    const std::string file = folder.write(
        "again.toml",
        "[arm1]\norder = [\"again\"]\n[arm1.again]\ngenerator = \"replay\"\nrecording = \"run\"\n" + keys);
    return run(folder, "move", {"--file", file, "--dry-run"});
  };
  for (const std::string space : {"joints", "xyz_angle_axis", "xyz_euler_zyz"}) {
    const Ended ended = again("space = \"" + space + "\"\n");
    EXPECT_EQ(ended.status, 0) << space << ended.all();
  }
  const Ended fast = again("space = \"motors\"\n");
  const std::string error = fast.last_err(), told = "give it ";
  EXPECT_NE(error.find("space = \"joints\""), std::string::npos) << error;
  ASSERT_NE(error.find(told), std::string::npos) << error;
  const Ended slower = again("space = \"motors\"\nstretch = " +
                             std::to_string(std::stod(error.substr(error.find(told) + told.size()))) + "\n");
  EXPECT_EQ(slower.status, 0) << "what is told is enough" << slower.all();
}

TEST(Guide, RefusesWhatCannotBeAFixtureBeforeAnythingMoves) {
  const Folder folder;
  const std::string broken = folder.write("broken.svg", "<svg");
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    const Ended ended = run(
        folder, "guide", words({{"--processes", "one", "--run-dir", (folder / "run").string()}, arguments}));
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.last_err().find(why), std::string::npos) << ended.all();
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  };
  refused({"--fixture", "spiral"}, "no such fixture");
  refused({"--fixture", "none.svg"}, "none.svg");
  refused({"--fixture", broken}, "broken.svg");
  const auto drawn = [&](const char* name, const std::string& path) {
    return folder.write(name, "<svg xmlns='http://www.w3.org/2000/svg'><path d='" + path + "'/></svg>");
  };
  refused({"--fixture", drawn("point.svg", "M1 1 L1 1")}, "point.svg: the stroke is a single point");
  refused({"--fixture", drawn("sharp.svg", "M0 0 L100 0 L0 1")}, "sharp.svg");
  refused({"--fixture", folder.path().string()}, "this is a folder");
  refused({"--size", "50"}, "--size and --stroke");
  refused({"--set", "task.centre=[1.6, 0, 1]"}, "does not reach");
  refused({"--set", "task.centre=[0.9, 0, 0.9]"}, "in the table");
  refused({"--set", "task.stiffness=50000"}, "may swing");
  refused({"--set", "sim.hand.mass=0.05"}, "sim.hand.mass");
}

TEST(Guide, StopsOnTheFixtureAsEveryTaskDoes) {
  const Folder folder;
  const std::string orders = folder.write("orders", "3 start\n1500 stop\n");
  const std::string run_folder = (folder / "run").string();
  const Ended ended =
      run(folder, "guide", {"--processes", "one", "--run-dir", run_folder, "--script", orders});
  EXPECT_EQ(ended.status, 1) << ended.all();
  const auto s = summary(run_folder);
  EXPECT_EQ(s.at("outcome"), "stopped");
  EXPECT_LE(s.at("figures").at("stop_steps_max").get<double>(), 100);
}

TEST(Guide, HoldsTheToolInAPauseToo) {
  const Folder folder;
  const std::string orders =
      folder.write("orders", "3 start\n1500 pause\n2000 resume\n4000 trigger\n4800 trigger\n");
  const auto s = led(folder, {"--script", orders});
  EXPECT_LE(figure(s, "fixture_dev_mm"), 1);
}

TEST(Guide, BrakesWhenItsControlSubsystemDiesWhileTheToolIsLed) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder(false);
  Started guide(folder, "guide", {"--speed", "4", "--run-dir", (folder / "run").string()});
  ASSERT_TRUE(guide.await_line("along the fixture"));
  const auto children = guide.children();
  ::kill(guide.child("ecp-arm1").pid, SIGKILL);
  const Ended ended = guide.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(all_gone(children));
}

}  // namespace
}  // namespace mrroc::test
