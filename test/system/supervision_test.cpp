// A supervisor is suspended, a part does not obey, the disk is full: what a task reports is true, and its
// arms rest.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/link/event_log.hpp"
#include "base/operator.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

std::vector<std::string> press(const Folder& folder, const std::string& name, std::vector<std::string> more) {
  more.insert(more.end(), {"--run-dir", (folder / name).string()});
  return more;
}

std::string messages(const std::filesystem::path& run) {
  std::ostringstream text;
  text << std::ifstream(run / "messages.log").rdbuf();
  return text.str();
}

TEST(Supervision, InLockStepARunGoesOnWhoeverSuspendsItsProgramForHoweverLong) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  Started task(folder, "press", press(folder, "run", {"--speed", "1"}));
  ASSERT_TRUE(task.await_line("approach"));
  task.signal(SIGTSTP);
  std::this_thread::sleep_for(kSanitized ? 1s : 34s);  // the others' timeout is 30 s
  task.signal(SIGCONT);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 0) << ended.all() << messages(folder / "run");
  const Ended plain = run(folder, "press", press(folder, "plain", {"--processes", "one"}));
  EXPECT_EQ(summary(folder / "run")["log_hash"], summary(folder / "plain")["log_hash"]);
}

TEST(Supervision, ByTheWallClockDriversRestWhenTheirSupervisorIsSuspendedAndHeIsBlamedForIt) {
  if (!multicast() || kSanitized) GTEST_SKIP() << "no multicast here, or no wall clock";
  const Folder folder;
  Started task(folder, "press", press(folder, "run", {"--clock", "wall"}));
  ASSERT_TRUE(task.await_line("m = 1  approach"));
  task.signal(SIGSTOP);
  std::this_thread::sleep_for(1s);
  const auto asked = Clock::now();
  const Ended stop = run(folder, "ui_cli", {"stop"});
  EXPECT_EQ(stop.status, 3);
  EXPECT_TRUE(stop.last_err().starts_with("error: peer_silent: stopped: arm1 at rest; mp does not answer"))
      << stop.all();
  EXPECT_LT(Clock::now() - asked, 4s);
  task.signal(SIGCONT);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(ended.last_err().starts_with("error: supervisor_silent: mp: ")) << ended.all();
  const std::string lines = messages(folder / "run");
  EXPECT_NE(lines.find("mp was not heard for 700 ms by edp-arm1: comes to rest"), std::string::npos) << lines;
  EXPECT_NE(lines.find("mp was not heard for 700 ms by ecp-arm1: comes to rest"), std::string::npos) << lines;
  const auto s = summary(folder / "run");
  EXPECT_EQ(s.at("outcome"), "fault");
  EXPECT_LE(figure(s, "stop_steps_max"), 100);
}

TEST(Supervision, ByTheWallClockCtrlZPausesAndGoesOnAgain) {
  if (!multicast() || kSanitized) GTEST_SKIP() << "no multicast here, or no wall clock";
  const Folder folder;
  Started task(folder, "press", press(folder, "run", {"--clock", "wall"}));
  ASSERT_TRUE(task.await_line("m = 1  approach"));
  task.signal(SIGTSTP);
  ASSERT_TRUE(task.await_line("Ctrl-Z pauses"));
  std::this_thread::sleep_for(1s);
  const Ended paused = run(folder, "ui_cli", {"status", "--json"});
  EXPECT_NE(paused.all().find("\"paused\""), std::string::npos) << paused.all();
  task.signal(SIGCONT);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 0) << ended.all() << messages(folder / "run");
}

TEST(Supervision, AStopThatADriverDoesNotConfirmIsNotAcceptedAndTheDriverIsEnded) {
  if (!multicast() || kSanitized) GTEST_SKIP() << "no multicast here, or no deadline";
  const Folder folder(false);
  Started task(folder, "press", press(folder, "run", {"--speed", "1"}));
  ASSERT_TRUE(task.await_line("m = 1  approach"));
  const ProcessId driver = task.child("edp-arm1");
  ::kill(driver.pid, SIGSTOP);
  const Ended stop = run(folder, "ui_cli", {"stop"});
  EXPECT_EQ(stop.status, 3);
  EXPECT_TRUE(stop.last_err().starts_with("error: stop_not_confirmed: stop: not confirmed by edp-arm1"))
      << stop.all();
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: stop_not_confirmed: edp-arm1: ")) << ended.all();
  EXPECT_NE(ended.all().find("edp-arm1 has not confirmed the stop in 3.0 s: SIGTERM"), std::string::npos);
  EXPECT_TRUE(all_gone({driver}));
}

TEST(Supervision, WhenTheDriverOfTheOnlyArmIsKilledItIsToldHowLongTheArmTookToRest) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  Started task(folder, "press", press(folder, "run", {"--speed", "1"}));
  ASSERT_TRUE(task.await_line("m = 1  approach"));
  ::kill(task.child("edp-arm1").pid, SIGKILL);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  const auto s = summary(folder / "run");
  ASSERT_TRUE(s.at("figures").contains("stop_steps_max")) << s;
  EXPECT_LE(figure(s, "stop_steps_max"), 100) << "its drives brake by themselves";
}

TEST(Supervision, APausedRunWhoseAgentHangsObeysEveryKindOfStop) {
  if (!multicast() || kSanitized) GTEST_SKIP() << "no multicast here, or no deadline";
  for (const int signal : {0, SIGTERM, SIGINT}) {
    const Folder folder(false);
    Started task(folder, "press", press(folder, "run", {"--speed", "1"}));
    ASSERT_TRUE(task.await_line("m = 1  approach"));
    EXPECT_EQ(run(folder, "ui_cli", {"pause"}).status, 0);
    ::kill(task.child("ecp-arm1").pid, SIGSTOP);
    const auto begun = Clock::now();
    if (signal == 0)
      EXPECT_EQ(run(folder, "ui_cli", {"stop"}).status, 3);
    else
      task.signal(signal);
    const Ended ended = task.end();
    EXPECT_EQ(ended.status, 3) << ended.all();
    EXPECT_LT(Clock::now() - begun, 10s);
  }
}

TEST(Supervision, AnOrderMayFollowTheOneBeforeAtOnce) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  // Slowly enough for the run to outlast all orders.
  const std::string speed = kSanitized ? "0.1" : "0.5";
  Started task(folder, "press", press(folder, "run", {"--speed", speed, "--attended"}));
  ASSERT_TRUE(task.await_line("waits for the operator"));
  while (run(folder, "ui_cli", {"status"}).all().find(to_string(TaskState::waiting_for_start)) ==
         std::string::npos)
    ASSERT_FALSE(task.children().empty());
  std::vector<std::string> orders{"start"};
  for (int k = 0; k < 40; ++k) orders.insert(orders.end(), {"pause", "resume"});
  for (const std::string& order : orders) {
    const Ended told = run(folder, "ui_cli", {order});
    ASSERT_EQ(told.status, 0) << told.all();
  }
  EXPECT_EQ(run(folder, "ui_cli", {"stop"}).status, 0);
  EXPECT_EQ(task.end().status, 1);
}

TEST(Supervision, AStopThatEverybodyConfirmsIsAccepted) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  Started task(folder, "press", press(folder, "run", {"--speed", "1"}));
  ASSERT_TRUE(task.await_line("m = 1  approach"));
  const Ended stop = run(folder, "ui_cli", {"stop"});
  EXPECT_EQ(stop.status, 0) << stop.all();
  EXPECT_EQ(stop.last_out(), "stop accepted: every process has confirmed it");
  EXPECT_EQ(task.end().status, 1);
}

TEST(Supervision, AThirdSignalKillsWhateverHangs) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder(false);
  Started task(folder, "press", press(folder, "run", {"--speed", "1"}));
  ASSERT_TRUE(task.await_line("m = 1  approach"));
  const auto parts = task.children();
  for (const ProcessId& part : parts) ::kill(part.pid, SIGSTOP);
  const auto begun = Clock::now();
  for (int k = 0; k < 3; ++k) {
    task.signal(SIGINT);
    std::this_thread::sleep_for(100ms);
  }
  const Ended ended = task.end();
  EXPECT_NE(ended.status, 0);
  EXPECT_LT(Clock::now() - begun, 3s);
  EXPECT_TRUE(all_gone(parts));
  EXPECT_EQ(summary(folder / "run").at("outcome"), "stopped");
}

/// @return how press ends when a shell runs it with a line around it, in which @ stands for it
Ended in_shell(const Folder& folder, std::string line) {
  const std::string command = MRROC_BIN "/press --processes one --run-dir " + (folder / "run").string();
  line.replace(line.find('@'), 1, command);
  return run(folder, "/bin/bash", {"-c", line});
}

TEST(Supervision, WhatIsToldToAnOutputThatIsClosedIsNotWrittenIntoTheLog) {
  const Folder folder;  // its runs are recomputed from their logs
  EXPECT_EQ(in_shell(folder, "exec @ <&- >&- 2>&-").status, 0);
  std::ifstream log(folder / "run/events.lcmlog", std::ios::binary);
  std::string begins(4, ' ');
  log.read(begins.data(), 4);
  EXPECT_EQ(begins, "\xED\xA1\xDA\x01") << "an event, and not a line for a person";
}

TEST(Supervision, WhereNoFileMayGrowAtAllARunEndsWithANamedError) {
  const Folder folder(false);
  const Ended ended = in_shell(folder, "ulimit -f 1; @ > /dev/null 2> >(cat >&2); exit $?");
  EXPECT_EQ(ended.status, 3) << ended.all();
}

/// A file system of that size, which this process and its children see alone.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& place, const std::string& size) {
    std::filesystem::create_directories(place);
    ready_ = ::unshare(CLONE_NEWNS) == 0 &&
             ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
             ::mount("tmpfs", place.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
    place_ = place;
  }
  ~SmallDisk() {
    if (ready_) ::umount2(place_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool ready() const { return ready_; }

 private:
  std::filesystem::path place_;
  bool ready_{};
};

TEST(Supervision, ADiskThatBecomesFullLeavesRoomForTheSummaryAndTheBlackBox) {
  const Folder folder(false);
  const SmallDisk disk(folder / "disk", "10m");
  if (!disk.ready()) GTEST_SKIP() << "only root may mount a small disk";
  const Ended ended = run(folder, "press", press(folder, "disk/run", {"--processes", "one"}));
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: cannot_write: ")) << ended.all();
  const auto s = summary(folder / "disk/run");
  EXPECT_EQ(s.at("fault").at("code"), "cannot_write");
  const auto files = s.at("black_box").get<std::vector<std::string>>();
  ASSERT_FALSE(files.empty());
  for (const std::string& file : files) {
    if (file.ends_with("simulator.txt")) continue;  // what it says to the drivers is in no log
    EXPECT_GT(std::filesystem::file_size(folder / "disk/run" / file), 10'000U) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "disk/run/reserve"));
}

TEST(Supervision, ADiskWithoutRoomForTheEndOfARunBeginsNone) {
  const Folder folder(false);
  const SmallDisk disk(folder / "disk", "4m");
  if (!disk.ready()) GTEST_SKIP() << "only root may mount a small disk";
  const Ended ended = run(folder, "press", press(folder, "disk/run", {"--processes", "one"}));
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: cannot_write: ")) << ended.all();
  EXPECT_NE(ended.last_err().find("8 MB are kept free"), std::string::npos) << ended.all();
}

TEST(Supervision, ALogThatReachesItsBoundEndsAndSaysSoAndTheRunIsTheSame) {
  const Folder folder;
  const Ended ended =
      run(folder, "press", press(folder, "run", {"--processes", "one", "--set", "log.limit_mb=1"}));
  EXPECT_EQ(ended.status, 0) << ended.all();
  EXPECT_NE(ended.all().find("events.lcmlog has reached log.limit_mb"), std::string::npos) << ended.all();
  EXPECT_LE(std::filesystem::file_size(folder / "run/events.lcmlog"), 1'000'000U);
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / link::kEventTail));
  EXPECT_GT(figure(summary(folder / "run"), "log_left_out"), 1000);
  const Ended plain = run(folder, "press", press(folder, "plain", {"--processes", "one"}));
  EXPECT_EQ(summary(folder / "run")["log_hash"], summary(folder / "plain")["log_hash"]);
  const Ended checked = run(folder, "ui_cli", {"log", "check", (folder / "run").string()});
  EXPECT_NE(checked.all().find("recomputed, 0 differ"), std::string::npos) << checked.all();
  EXPECT_NE(checked.all().find("it ends where log.limit_mb let it"), std::string::npos) << checked.all();
}

TEST(Supervision, AConfigurationThatLostItsSynchroRunsAsBefore) {
  const Folder folder;
  ASSERT_EQ(run(folder, "press", press(folder, "first", {"--processes", "one"})).status, 0);
  std::ifstream in(folder / "first/config.toml");
  std::string text;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with("synchro =")) text += line + "\n";
  const Ended again =
      run(folder, "press",
          press(folder, "again", {"--processes", "one", "--config", folder.write("damaged.toml", text)}));
  EXPECT_EQ(again.status, 0) << again.all();
  EXPECT_EQ(summary(folder / "first")["log_hash"], summary(folder / "again")["log_hash"]);
}

}  // namespace
}  // namespace mrroc::test
