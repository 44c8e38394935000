// Tasks of arms on the simulator's second engine, as a user starts them.
#include <gtest/gtest.h>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

const std::vector<std::string> kOnMujoco{"--set", "sim.engine=\"mujoco\""};

#ifdef MRROC_MUJOCO

nlohmann::json summary_of(const Folder& folder, const std::string& task, const std::string& name,
                          const std::vector<std::string>& more) {
  const Ended ended =
      run(folder, task,
          words({{"--processes", "one", "--seed", "1", "--run-dir", (folder / name).string()}, more}));
  EXPECT_EQ(ended.status, 0) << ended.all();
  return summary(folder / name);
}

void expect_within(const nlohmann::json& figure, const nlohmann::json& bounds, const std::string& name) {
  if (figure.is_array()) {
    for (const auto& each : figure) expect_within(each, bounds, name);
    return;
  }
  if (!bounds[0].is_null()) {
    EXPECT_GE(figure.get<double>(), bounds[0].get<double>()) << name;
  }
  if (!bounds[1].is_null()) {
    EXPECT_LE(figure.get<double>(), bounds[1].get<double>()) << name;
  }
}

class TaskOnMujoco : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Engines, TaskOnMujoco, testing::Values("press", "weigh", "edge_follow", "drawing"),
                         [](const auto& of) { return std::string(of.param); });

TEST_P(TaskOnMujoco, ReachesWhatItWantsWithTheBarsOfTheFirstEngine) {
  const Folder folder;
  const auto s = summary_of(folder, GetParam(), "run", kOnMujoco);
  EXPECT_EQ(s.at("outcome"), "done");
  for (const auto& [name, bounds] : s.at("wanted").items())
    expect_within(s.at("figures").at(name), bounds, name);
}

TEST(Engines, GiveRunsOfTheirOwnThatRepeatToTheBit) {
  const Folder folder;
  const auto mujoco = summary_of(folder, "press", "mujoco", kOnMujoco).at("log_hash");
  EXPECT_EQ(summary_of(folder, "press", "again", kOnMujoco).at("log_hash"), mujoco);
  const auto bullet =
      summary_of(folder, "press", "bullet", {"--set", "sim.engine=\"bullet\""}).at("log_hash");
  EXPECT_NE(bullet, mujoco);
  EXPECT_EQ(summary_of(folder, "press", "usual", {}).at("log_hash"), bullet);
}

TEST(Engines, WeighTheSameTool) {
  const Folder folder;
  const auto bullet = summary_of(folder, "weigh", "bullet", {}).at("figures");
  const auto mujoco = summary_of(folder, "weigh", "mujoco", kOnMujoco).at("figures");
  EXPECT_NEAR(mujoco.at("tool_weight_N").get<double>(), bullet.at("tool_weight_N").get<double>(), 0.01);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(mujoco.at("tool_mass_centre_m")[k].get<double>(),
                bullet.at("tool_mass_centre_m")[k].get<double>(), 2e-4);
}

#else

TEST(Engines, ThatAreNotBuiltAreRefusedWithWhatToDo) {
  const Folder folder;
  const Ended ended = run(folder, "press",
                          words({{"--processes", "one", "--run-dir", (folder / "run").string()}, kOnMujoco}));
  EXPECT_NE(ended.status, 0);
  EXPECT_TRUE(
      ended.last_err().starts_with("error: bad_configuration: sim.engine: this build has no MuJoCo; "
                                   "take \"bullet\", or build with it"))
      << ended.all();
}

#endif

TEST(Engines, RefuseACubeInMujoco) {
  const Folder folder;
  const Ended ended = run(folder, "rubik",
                          words({{"--processes", "one", "--run-dir", (folder / "run").string()}, kOnMujoco}));
  EXPECT_NE(ended.status, 0);
  EXPECT_TRUE(ended.last_err().starts_with("error: bad_configuration: sim.engine: ")) << ended.all();
}

}  // namespace
}  // namespace mrroc::test
