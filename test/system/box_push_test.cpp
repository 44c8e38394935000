// Two platforms push a box, as a user starts them.
#include <gtest/gtest.h>

#include <algorithm>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// Platforms that stand behind the box already.
std::vector<std::string> short_push(const Folder& folder, const std::string& name) {
  return {"--to",      "0.8",
          "0",         "0",
          "--set",     "sim.platforms.rex1.start=[-1.1, 0.54, 0]",
          "--set",     "sim.platforms.rex2.start=[-1.1, -0.54, 0]",
          "--run-dir", (folder / name).string()};
}

TEST(BoxPush, BringsTheBoxToItsGoalWithTheSameBitsInOneProcessAndInSeveral) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder;
  nlohmann::json told[2];
  for (const bool one : {false, true}) {
    const std::string name = one ? "one" : "separate";
    const Ended ended = run(folder, "box_push", words({short_push(folder, name), {"--processes", name}}));
    ASSERT_EQ(ended.status, 0) << ended.all();
    told[one ? 1 : 0] = summary(folder / name);
  }
  EXPECT_NE(told[0].at("log_hash"), "0000000000000000");
  EXPECT_EQ(told[0].at("log_hash"), told[1].at("log_hash"));
  EXPECT_EQ(told[0].at("figures"), told[1].at("figures"));
  EXPECT_LE(figure(told[0], "box_err_mm"), 30);
  EXPECT_LE(figure(told[0], "box_err_deg"), 5);
  EXPECT_GT(figure(told[0], "push_mean_N"), 275) << "more than the traction of one platform";
}

TEST(BoxPush, StandsDuringAPauseAndComesToItsGoal) {
  const Folder folder;
  const std::string script = folder.write("orders", "3 start\n500 pause\n550 resume\n");
  const Ended ended =
      run(folder, "box_push", words({short_push(folder, "run"), {"--processes", "one", "--script", script}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "box_err_mm"), 30);
}

TEST(BoxPush, RefusesAGoalThatIsNoneBeforeAnythingStarts) {
  const Folder folder;
  for (const auto& [to, named] :
       {std::pair<std::vector<std::string>, std::string>{{"4.9", "0", "0"}, "--to [4.9, 0, 0]: "},
        {{"1", "2"}, "--to"}}) {
    const Ended ended =
        run(folder, "box_push", words({{"--to"}, to, {"--run-dir", (folder / "run").string()}}));
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.all().find(named), std::string::npos) << ended.all();
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  }
}

}  // namespace
}  // namespace mrroc::test
