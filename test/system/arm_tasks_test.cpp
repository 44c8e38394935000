// The tasks press, edge_follow and weigh as a user starts them: what they must reach, and that they obey.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "base/link/log_reader.hpp"
#include "mrroc/task_status_t.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// @return names and sizes of the files of a folder and of those below
std::vector<std::pair<std::string, std::uintmax_t>> files_of(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, std::uintmax_t>> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.emplace_back(entry.path().string(), entry.file_size());
  std::ranges::sort(files);
  return files;
}

TEST(Press, SettlesAtFourNewtonsAndDrawsBack) {
  const Folder folder;
  const Ended ended = run(folder, "press", {"--processes", "one", "--run-dir", (folder / "run").string()});
  ASSERT_EQ(ended.status, 0) << ended.all();
  const auto s = summary(folder / "run");
  EXPECT_EQ(s.at("outcome"), "done");
  EXPECT_NEAR(s.at("figures").at("approach_settled_N").get<double>(), 4, 0.1);
  EXPECT_NEAR(s.at("figures").at("hold_N").get<double>(), 4, 0.1);
  EXPECT_GT(s.at("figures").at("approach_peak_N").get<double>(), 4);
  EXPECT_LT(s.at("figures").at("approach_peak_N").get<double>(), 8);
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / "arm1.csv"));
  const auto told = link::LogReader(folder / "run").messages<task_status_t>("task_status");
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.rbegin()->second.progress, 1) << "all is done";
}

TEST(Press, SaysTheSameInSeparateProcesses) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  for (const std::string mode : {"one", "separate"}) {
    const Ended ended = run(folder, "press", {"--processes", mode, "--run-dir", (folder / mode).string()});
    ASSERT_EQ(ended.status, 0) << ended.all();
  }
  EXPECT_EQ(summary(folder / "one")["log_hash"], summary(folder / "separate")["log_hash"]);
}

/// @return how press ends when a shell runs it with a line around it, in which @ stands for it
Ended in_shell(const Folder& folder, const std::string& line) {
  const std::string press = MRROC_BIN "/press --processes one --run-dir " + (folder / "run").string();
  std::string typed = line;
  typed.replace(typed.find('@'), 1, press);
  return run(folder, "/bin/bash", {"-c", typed});
}

TEST(Press, ComesToItsEndThoughNobodyReadsWhatItTells) {
  const Folder folder;
  const Ended ended = in_shell(folder, "@ | head -n 1; exit ${PIPESTATUS[0]}");
  EXPECT_EQ(ended.status, 0) << ended.all();
  EXPECT_EQ(summary(folder / "run").at("outcome"), "done");
}

TEST(Press, StopsWithAFaultWhereItsLogMayGrowNoLongerAndLeavesItsSummary) {
  const Folder folder(false);
  const Ended ended = in_shell(folder, "ulimit -f 256; exec @");
  EXPECT_TRUE(ended.last_err().starts_with("error: cannot_write: ")) << ended.all();
  EXPECT_EQ(summary(folder / "run").at("fault").at("code"), "cannot_write");
}

TEST(Press, StopsAsByAnOrderWhenItsTerminalIsClosedUnlessTheCallerWantsItToGoOn) {
  const Folder folder;
  const auto press = [&](const std::string& around, const std::string& name) {
    return "exec " + around + MRROC_BIN "/press --processes one --speed 5 --run-dir " +
           (folder / name).string();
  };
  Started task(folder, "/bin/bash", {"-c", press("", "closed")}, "closed");
  ASSERT_TRUE(task.await_line("approach"));
  task.signal(SIGHUP);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: interrupted: a signal ended the task (SIGHUP)"))
      << ended.all();
  EXPECT_EQ(summary(folder / "closed").at("outcome"), "stopped");
  Started other(folder, "/bin/bash", {"-c", press("nohup ", "nohup")}, "nohup");
  ASSERT_TRUE(other.await_line("approach"));
  other.signal(SIGHUP);
  EXPECT_EQ(other.end().status, 0);
}

TEST(Press, IsRepeatedFromTheConfigurationOfItsRunInAFolderOfItsOwn) {
  const Folder folder;
  const auto press = [&](const std::string& name, const std::vector<std::string>& more) {
    const Ended ended =
        run(folder, "press", words({{"--processes", "one", "--run-dir", (folder / name).string()}, more}));
    EXPECT_EQ(ended.status, 0) << ended.all();
    EXPECT_TRUE(ended.out.front().ends_with("seed 7")) << ended.all();
    return summary(folder / name)["log_hash"];
  };
  const auto hash = press("first", {"--seed", "7", "--set", "sim.substeps=4"});
  const auto before = files_of(folder / "first");
  const std::string config = folder / "first" / "config.toml";
  EXPECT_EQ(press("again", {"--config", config}), hash);
  EXPECT_NE(press("other", {"--config", config, "--set", "sim.substeps=3"}), hash);
  EXPECT_EQ(press("part", {"--config", folder.write("part.toml", "seed = 7\n[sim]\nsubsteps = 4\n")}), hash)
      << "what a file leaves out is as built in";
  EXPECT_EQ(press("set", {"--set", "seed=7", "--set", "sim.substeps=4"}), hash);
  EXPECT_EQ(files_of(folder / "first"), before) << "another run wrote into the folder of the first";
}

TEST(Press, StandsStillDuringAPauseAndGoesOn) {
  const Folder folder;
  const std::string orders = folder.write("orders", "3 start\n120 pause\n320 resume\n");
  const auto press = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--processes", "one", "--run-dir", (folder / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = run(folder, "press", arguments);
    EXPECT_EQ(ended.status, 0) << ended.all();
    return summary(folder / name);
  };
  const double plain = press("plain", {})["sim_s"];
  const auto paused = press("paused", {"--script", orders, "--speed", "50"});
  EXPECT_NEAR(paused.at("sim_s").get<double>() - plain, 4, 0.2) << "200 macrosteps of 20 ms";
  EXPECT_NEAR(paused.at("figures").at("hold_N").get<double>(), 4, 0.1);
}

TEST(Press, DoesNotRaceThroughMacrostepsWhileOnlyAPersonCanGoOn) {
  using Clock = std::chrono::steady_clock;
  const Folder folder;
  const auto begun = Clock::now();
  Started press(folder, "press",
                {"--attended", "--processes", "one", "--run-dir", (folder / "run").string()});
  ASSERT_TRUE(press.await_line("waits for the operator"));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  press.signal(SIGINT);
  const Ended ended = press.end();
  EXPECT_EQ(ended.status, 1) << ended.all();
  const double passed = std::chrono::duration<double>(Clock::now() - begun).count();
  EXPECT_LT(summary(folder / "run")["sim_s"].get<double>(), passed + 0.5) << "--speed is max";
}

TEST(Press, StopsInRealTimeAsItsRecordedScriptDoes) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  const auto arguments = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"--run-dir", (folder / name).string(), "--set", "robots.arm1.record=always"});
    return more;
  };
  Started press(folder, "press", arguments("live", {"--speed", "1"}));
  ASSERT_TRUE(press.await_line("m = 1  approach")) << press.end().all();
  EXPECT_EQ(run(folder, "ui_cli", {"stop"}).status, 0);
  EXPECT_EQ(press.end().status, 1);
  const Ended again = run(
      folder, "press",
      arguments("again", {"--processes", "one", "--script", (folder / "live" / "operator.script").string()}));
  EXPECT_EQ(again.status, 1) << again.all();
  // The set points of all steps: the same until the arm rests, whatever follows until the processes end.
  std::ifstream live(folder / "live" / "arm1-steps.csv"), replayed(folder / "again" / "arm1-steps.csv");
  std::string a, b;
  bool decelerated = false;
  while (std::getline(live, a) && std::getline(replayed, b) && a.find(",holding,") == std::string::npos) {
    ASSERT_EQ(a, b);
    decelerated = decelerated || a.find(",decelerating,") != std::string::npos;
  }
  EXPECT_TRUE(decelerated);
  for (const std::string name : {"live", "again"})
    EXPECT_EQ(run(folder, "ui_cli", {"log", "check", (folder / name).string()}).status, 0) << name;
}

TEST(Press, AnEmergencyStopBrakesAtOnceAndLeavesItsBlackBox) {
  const Folder folder;
  const std::string orders = folder.write("orders", "3 start\n120 e-stop\n");
  std::vector<std::string> modes{"one"};
  if (multicast()) modes.emplace_back("separate");
  for (const std::string& mode : modes) {
    const auto run_folder = folder / mode;
    const Ended ended =
        run(folder, "press",
            {"--processes", mode, "--script", orders, "--speed", "20", "--run-dir", run_folder.string()});
    EXPECT_EQ(ended.status, 1) << ended.all();
    EXPECT_TRUE(ended.last_err().starts_with("error: emergency_stop:")) << ended.last_err();
    const auto s = summary(run_folder);
    EXPECT_EQ(s.at("outcome"), "stopped");
    EXPECT_EQ(s.at("fault").at("code"), "emergency_stop");
    EXPECT_LT(s.at("sim_s").get<double>(), 4) << "120 macrosteps of 20 ms";
    const auto files = s.at("black_box").get<std::vector<std::string>>();
    for (const char* process : {"mp", "simulator", "edp-arm1", "ecp-arm1"})
      EXPECT_TRUE(std::ranges::count(files, std::string("black_box/") + process + ".txt")) << process;
    EXPECT_TRUE(std::ranges::any_of(files, [](const auto& f) { return f.starts_with("arm1-fault-"); }))
        << "the steps of the driver";
    EXPECT_TRUE(
        std::ranges::any_of(files, [](const auto& f) { return f.starts_with("simulator-arm1-fault-"); }));
    for (const std::string& file : files) EXPECT_TRUE(std::filesystem::exists(run_folder / file)) << file;
    const Ended checked = run(folder, "ui_cli", {"log", "check", run_folder.string()});
    EXPECT_EQ(checked.status, 0) << checked.all();
  }
}

TEST(Press, TheBlackBoxTellsOfADriverThatIsKilled) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  Started press(folder, "press", {"--speed", "1", "--run-dir", (folder / "run").string()});
  ASSERT_TRUE(press.await_line("approach"));
  ::kill(press.child("edp-arm1").pid, SIGKILL);
  const Ended ended = press.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  const auto files = summary(folder / "run")["black_box"].get<std::vector<std::string>>();
  EXPECT_TRUE(std::ranges::count(files, "black_box/edp-arm1.txt"));
  EXPECT_TRUE(std::ranges::any_of(files, [](const auto& f) {
    return f.starts_with("simulator-arm1-fault-");
  })) << "what its drives saw";
}

TEST(Press, RefusesAMacrostepThatItsRowsDoNotCommand) {
  const Folder folder;
  const Ended ended = run(folder, "press", {"--set", "time.n_s=8", "--run-dir", (folder / "run").string()});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.last_err().find("time.n_s"), std::string::npos) << ended.last_err();
}

TEST(Weigh, FindsTheToolThatTheArmHasWhateverItIsToldOfIt) {
  const Folder folder;
  const Ended ended = run(
      folder, "weigh",
      {"--processes", "one", "--set", "robots.arm1.tool.weight=0", "--run-dir", (folder / "run").string()});
  ASSERT_EQ(ended.status, 0) << ended.all();
  const auto s = summary(folder / "run");
  EXPECT_EQ(s.at("outcome"), "done");
  EXPECT_NEAR(s.at("figures").at("tool_weight_N").get<double>(), 10.8, 0.1) << "the pen and its holder";
  const auto centre = s.at("figures").at("tool_mass_centre_m").get<std::vector<double>>();
  ASSERT_EQ(centre.size(), 3U);
  EXPECT_NEAR(centre[0], 0.004, 2e-3);
  EXPECT_NEAR(centre[1], 0, 2e-3);
  EXPECT_NEAR(centre[2], 0.156, 2e-3);
  EXPECT_NE(ended.all().find("mass_centre = ["), std::string::npos) << "lines for a configuration";
}

TEST(EdgeFollow, KeepsFourNewtonsAroundBothPlates) {
  const Folder folder;
  const Ended ended =
      run(folder, "edge_follow", {"--processes", "one", "--run-dir", (folder / "run").string()});
  ASSERT_EQ(ended.status, 0) << ended.all();
  const auto f = summary(folder / "run")["figures"];
  ASSERT_EQ(f.at("edge_follow_rms_N").size(), 2u);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    EXPECT_LE(f.at("edge_follow_rms_N").at(arm).get<double>(), 0.5);
    EXPECT_NEAR(f.at("edge_follow_mean_N").at(arm).get<double>(), 4, 0.25);
    EXPECT_GT(f.at("edge_follow_s").at(arm).get<double>(), 25) << "once around at 8 mm/s";
  }
}

TEST(EdgeFollow, GoesTheOtherWayRoundToo) {
  const Folder folder;
  const Ended ended = run(
      folder, "edge_follow",
      {"--processes", "one", "--set", "task.speed_per_force=-0.002", "--run-dir", (folder / "run").string()});
  ASSERT_EQ(ended.status, 0) << ended.all();
  const auto figures = summary(folder / "run")["figures"];
  for (const double rms : figures.at("edge_follow_rms_N")) EXPECT_LE(rms, 0.5);
}

}  // namespace
}  // namespace mrroc::test
