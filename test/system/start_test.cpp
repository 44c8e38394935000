// Starts that fail say why, and leave nothing that stands in the way of the next one.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

class Starts : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }
  Folder folder_{false};
};

TEST_F(Starts, AUsedSessionNameLeavesNoFolderThatBlocksTheNextTry) {
  const std::string folder = folder_ / "second";
  {
    Started first(folder_, "press",
                  {"--session", "cell", "--attended", "--run-dir", (folder_ / "first").string()}, "first");
    ASSERT_TRUE(first.await_line("session cell"));
    const Ended second = run(folder_, "press", {"--session", "cell", "--run-dir", folder});
    EXPECT_EQ(second.status, 3) << second.all();
    EXPECT_NE(second.last_err().find("error: session_in_use"), std::string::npos) << second.all();
    EXPECT_FALSE(fs::exists(folder));
    EXPECT_EQ(run(folder_, "ui_cli", {"stop"}).status, 0) << "the first one is as it was";
    EXPECT_EQ(first.end().status, 1);
  }
  const Ended again = run(folder_, "press", {"--session", "cell", "--run-dir", folder});
  EXPECT_EQ(again.status, 0) << again.all();
}

TEST_F(Starts, ALockThatIsHeldEndsTheStartAndItsHolderIsNamed) {
  const fs::path sessions = folder_ / ("mrroc-" + std::to_string(::geteuid()));
  fs::create_directory(sessions);
  const int held = ::open((sessions / ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  const auto begun = std::chrono::steady_clock::now();
  const std::string folder = folder_ / "run";
  const Ended end = run(folder_, "press", {"--session", "cell", "--run-dir", folder});
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(kSanitized ? 60 : 15));
  EXPECT_EQ(end.status, 3) << end.all();
  EXPECT_NE(end.last_err().find("process " + std::to_string(::getpid()) + " ("), std::string::npos)
      << end.all();
  EXPECT_FALSE(fs::exists(folder));
  ::close(held);
}

TEST_F(Starts, ASignalAtAnyTimeLeavesNoFolderWithoutASummary) {
  const fs::path folder = folder_ / "run";
  // At first as soon as anything of the folder is there.
  for (const int ms : {0, 0, 0, 2, 5, 10, 20, 50, 100}) {
    Started press(folder_, "press", {"--run-dir", folder.string(), "--attended"});
    const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!fs::exists(folder) && std::chrono::steady_clock::now() < late) ::usleep(100);
    ::usleep(1000 * ms);
    press.signal(SIGINT);
    const Ended end = press.end();
    EXPECT_NE(end.status, 0) << ms;
    if (fs::exists(folder)) {
      EXPECT_TRUE(fs::exists(folder / "summary.json")) << ms << " ms: " << end.all();
      EXPECT_EQ(end.status, 1) << ms << " ms: " << end.all();
    }
    fs::remove_all(folder);
  }
}

TEST_F(Starts, ANetworkThatLosesMessagesIsToldInTheFirstLine) {
  Started press(folder_, "press", {"--attended", "--set", "link.loss=0.02", "--run-dir", folder_ / "run"});
  EXPECT_TRUE(press.await_line("every process loses 2 % of its messages (link.loss)"));
  press.signal(SIGINT);
  EXPECT_EQ(press.end().status, 1);
}

TEST_F(Starts, ADiskThatIsFullBehindTheOutputIsAnError) {
  for (const std::string words :
       {"press --parameters", "press --help", "ui_cli explain", "edp_irb6 --help"}) {
    const std::string program = words.substr(0, words.find(' '));
    const std::string line =
        started_program(program).string() + words.substr(program.size()) + " > /dev/full";
    const Ended end = run(folder_, "/bin/sh", {"-c", line});
    EXPECT_EQ(end.status, 3) << words << end.all();
    EXPECT_TRUE(end.last_err().starts_with("error: cannot_write: ")) << words << end.all();
  }
}

TEST_F(Starts, AReceivedConfigurationRunsNothing) {
  const fs::path proof = folder_ / "proof";
  const std::string program = folder_.write("evil", "#!/bin/sh\ntouch " + proof.string() + "\nexec \"$@\"\n");
  fs::permissions(program, fs::perms::owner_all);
  const std::string hosts = "[hosts.x]\nprocesses = [\"simulator\"]\n";
  const std::string with = folder_.write("with.toml", hosts + "start = [\"" + program + "\"]\n");
  const std::string without = folder_.write("without.toml", hosts);
  for (const std::string& config : {with, without}) {
    const Ended end = run(folder_, "press", {"--config", config, "--run-dir", (folder_ / "run").string()});
    EXPECT_EQ(end.status, 2) << end.all();
    EXPECT_NE(end.last_err().find("--host"), std::string::npos) << end.all();
    EXPECT_FALSE(fs::exists(folder_ / "run"));
  }
  EXPECT_EQ(
      run(folder_, "press", {"--config", with, "--host", "x=env", "--run-dir", (folder_ / "run").string()})
          .status,
      2);
  EXPECT_FALSE(fs::exists(proof));
  const Ended end =
      run(folder_, "press",
          {"--config", without, "--host", "x=" + program, "--run-dir", (folder_ / "run").string()});
  EXPECT_EQ(end.status, 0) << end.all();
  EXPECT_TRUE(fs::exists(proof));
  ASSERT_FALSE(end.out.empty());
  EXPECT_EQ(end.out.front(), "host x: simulator will be started with `" + program + " PROGRAM ...`");
}

TEST_F(Starts, TheKeyIsInNoCommandLineEnvironmentOrFileOfTheRun) {
  Started press(folder_, "press", {"--attended", "--run-dir", (folder_ / "run").string()});
  ASSERT_TRUE(press.await_line("session press"));
  const Ended list = run(folder_, "ui_cli", {"list", "--json"});
  std::string text;
  for (const auto& line : list.out) text += line;
  const fs::path key_file = nlohmann::json::parse(text).at(0).at("key_file").get<std::string>();
  std::string key;
  std::getline(std::ifstream(key_file), key);
  ASSERT_EQ(key.size(), 64U);
  auto processes = press.children();
  ASSERT_FALSE(processes.empty());
  for (const ProcessId& p : processes)
    for (const char* const of : {"cmdline", "environ"}) {
      std::ifstream in("/proc/" + std::to_string(p.pid) + "/" + of, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      EXPECT_EQ(bytes.find(key), std::string::npos) << p.command;
    }
  EXPECT_EQ(run(folder_, "ui_cli", {"stop"}).status, 0);
  press.end();
  EXPECT_FALSE(fs::exists(key_file)) << "it ends with the session";
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "run")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(bytes.find(key), std::string::npos) << entry.path();
  }
}

}  // namespace
}  // namespace mrroc::test
