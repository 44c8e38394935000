// Every task by the wall clock, alone and beside a load: it runs, or says in time that the host is too slow. Never silence.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Programs that want all cores for themselves.
class Load {
 public:
  explicit Load(unsigned processes) {
    for (unsigned k = 0; k < processes; ++k) {
      const pid_t parent = ::getpid(), pid = ::fork();
      if (pid == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // it ends with the test, also with one that is killed
        if (::getppid() != parent) ::_exit(0);
        for (volatile unsigned long n = 0;;) n = n + 1;
      }
      busy_.push_back(pid);
    }
  }
  ~Load() {
    for (const pid_t pid : busy_) {
      ::kill(pid, SIGKILL);
      ::waitpid(pid, nullptr, 0);
    }
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::vector<pid_t> busy_;
};

/// A task, and what it needs to come to something soon.
struct WallRun {
  std::string task;
  std::vector<std::string> arguments;  ///< FILE: name of the file
  std::string file;                    ///< its content; empty: there is none
  std::string line{" s  "};            ///< of the first behaviour
};
void PrintTo(const WallRun& k, std::ostream* out) { *out << k.task; }  // NOLINT: the name that gtest wants

const std::vector<WallRun> kRuns{
    {"press", {}, ""},
    {"weigh", {}, ""},
    {"edge_follow", {}, ""},
    {"move", {}, ""},
    {"drawing", {"--drawing", "FILE", "--size", "10"}, lines_svg(1)},
    {"manual",
     {"--words", "FILE", "--set", "robots.arm1.synchro=known_pose", "--set",
      "robots.arm2.synchro=known_pose"},
     "3 home all\n100 move arm1 joints 0.1 -1.5 0 1.5 1.57 -1.57 speed 0.5 acceleration 0.2\n1000 end\n",
     "s  arm1  move"},
    {"visual_servo", {}, "", "PB-"},
    {"rubik", {"--scramble", "U'", "--set", "task.tables=small"}, "", "show"},
};

/// Within what a task by the wall clock must have begun or ended: assembling, with shaders to compile on a loaded machine,
/// and the ten seconds in which a host that is too slow is named.
constexpr auto kSoon = 90s;

/// What a host that lacks time may end with; the last ones when it does not run a process at all for so long.
const std::vector<std::string> kLacks{"host_too_slow",     "hardware_silent",          "peer_silent",
                                      "supervisor_silent", "command_repeated_refused", "process_hung"};

class EveryTaskByTheWallClock : public ::testing::TestWithParam<WallRun> {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers cannot keep to the clock";
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }

  /// @param real_time  false: the right to SCHED_FIFO, which root has, is taken away
  void begins_or_says_why_not(bool real_time) {
    const WallRun& k = GetParam();
    const Folder folder(false);  // with the wall clock nothing is recomputed
    std::vector<std::string> arguments =
        words({{"--clock", "wall", "--run-dir", (folder / "run").string()}, k.arguments});
    if (!k.file.empty()) std::ranges::replace(arguments, "FILE", folder.write("file", k.file));
    std::string program = started_program(k.task);
    if (!real_time && ::geteuid() == 0) {
      arguments.insert(arguments.begin(), {"--bounding-set", "-sys_nice", program});
      program = "/usr/bin/setpriv";
    }
    const auto started = Clock::now();
    Started task(folder, program, arguments);
    const bool begun = task.await_line(k.line);
    EXPECT_LT(Clock::now() - started, kSoon);
    if (begun) {
      std::this_thread::sleep_for(3s);
      task.signal(SIGINT);
    }
    const Ended ended = task.end();
    EXPECT_LT(Clock::now() - started, kSoon + 40s);
    EXPECT_NE(ended.status, 137) << "it did not end\n" << ended.all();
    const auto told = summary(folder / "run");
    const std::string fault =
        told.at("fault").is_object() ? told.at("fault").at("code").get<std::string>() : std::string();
    if (!fault.empty() && fault != "interrupted") {
      EXPECT_TRUE(std::ranges::count(kLacks, fault)) << ended.all();
    } else {
      EXPECT_TRUE(begun) << ended.all();
    }
    const auto about_lateness = std::ranges::count_if(
        ended.out, [](const std::string& line) { return line.starts_with("late periods: "); });
    EXPECT_LE(about_lateness, 1 + (Clock::now() - started) / 10s);
  }
};

TEST_P(EveryTaskByTheWallClock, BeginsOrSaysWhatTheHostLacks) { begins_or_says_why_not(true); }

TEST_P(EveryTaskByTheWallClock, BeginsOrSaysWhatTheHostLacksWithoutRealTime) {
  begins_or_says_why_not(false);
}

TEST_P(EveryTaskByTheWallClock, BeginsOrSaysWhatTheHostLacksBesideALoad) {
  const Load load(2 * std::thread::hardware_concurrency());
  begins_or_says_why_not(false);
}

INSTANTIATE_TEST_SUITE_P(Of, EveryTaskByTheWallClock, ::testing::ValuesIn(kRuns),
                         [](const auto& named) { return named.param.task; });

/// What the kernel knows of a thread: fields of /proc/PID/task/TID/stat.
struct ThreadState {
  long nice{};
  long policy{};
};

std::vector<ThreadState> threads_of(pid_t pid) {
  std::vector<ThreadState> threads;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
    std::ifstream file(entry.path() / "stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::vector<std::string> field(50);
    for (std::string& f : field) fields >> f;  // the first one is field 3
    threads.push_back({std::stol(field[19 - 3]), std::stol(field[41 - 3])});
  }
  return threads;
}

class VisualServoByTheWallClock : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers cannot keep to the clock";
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }
  std::vector<std::string> task(std::vector<std::string> more = {}) {
    return words({{"--clock", "wall", "--run-dir", (folder_ / "run").string()}, std::move(more)});
  }
  Folder folder_{false};
};

TEST_F(VisualServoByTheWallClock, DrawsInThreadsThatAreInNobodysWay) {
  Started servo(folder_, "visual_servo", task());
  ASSERT_TRUE(servo.await_line(" s  ")) << servo.end().all();
  const auto threads = threads_of(servo.child("simulator").pid);
  EXPECT_EQ(std::ranges::count_if(threads,
                                  [](const ThreadState& t) { return t.nice > 0 && t.policy == SCHED_OTHER; }),
            2)
      << "one for each camera";
  for (const char* const receptor : {"vsp-sac", "vsp-eih"})
    EXPECT_TRUE(std::ranges::any_of(threads_of(servo.child(receptor).pid), [](const ThreadState& t) {
      return t.nice > 0 && t.policy == SCHED_OTHER;
    })) << receptor;
  servo.signal(SIGINT);
  servo.end();
}

TEST_F(VisualServoByTheWallClock, SaysThatThePicturesAreTooOldWhenTheyCannotBeDrawn) {
  // Large pictures over a long exposure: a second or more for each, on any processor of today.
  const Ended ended = run(folder_, "visual_servo",
                          task({"--cameras", "sac", "--set", "cameras.sac.width=2000", "--set",
                                "cameras.sac.height=1500", "--set", "cameras.sac.picture=grey", "--set",
                                "cameras.sac.exposure=18", "--set", "cameras.sac.instants=19"}));
  ASSERT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: host_too_slow: ")) << ended.last_err();
  const auto told = summary(folder_ / "run");
  EXPECT_LT(told.at("sim_s").get<double>(), 15) << "timeout, and what comes before the task";
}

TEST_F(VisualServoByTheWallClock, SaysThatTheHostIsTooSlowWhenTheSimulatorHasNoTime) {
  Started servo(folder_, "visual_servo", task());
  ASSERT_TRUE(servo.await_line(" s  ")) << servo.end().all();
  const ProcessId simulator = servo.child("simulator");
  const auto begun = Clock::now();
  while (simulator.runs() && Clock::now() - begun < 20s) {  // it gets half of the time
    ::kill(simulator.pid, SIGSTOP);
    std::this_thread::sleep_for(100ms);
    ::kill(simulator.pid, SIGCONT);
    std::this_thread::sleep_for(60ms);
  }
  EXPECT_LT(Clock::now() - begun, 15s);
  const Ended ended = servo.end();
  ASSERT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: host_too_slow: ")) << ended.last_err();
}

class DriversByTheWallClock : public VisualServoByTheWallClock {
 protected:
  /// @return as the process has told: "late: 12 skipped, 40 in all"
  [[nodiscard]] long steps_passed_over(const std::string& process) const {
    std::ifstream file(folder_ / "run" / "messages.log");
    long in_all = 0;
    for (std::string line; std::getline(file, line);)
      if (line.find(" " + process + " ") != std::string::npos)
        if (const auto at = line.find(" skipped, "); at != std::string::npos)
          in_all = std::stol(line.substr(at + 10));
    return in_all;
  }
};

TEST_F(DriversByTheWallClock, AreNotScheduledForAMomentAndTheArmGoesOnAsIfNothingHadHappened) {
  const std::string script =
      folder_.write("words",
                    "3 home all\n100 move arm1 joints 1.2 -1.5 0 1.5 1.57 1.5 speed 1 acceleration 0.5\n"
                    "400 move arm1 joints -0.5 -1.5 0 1.5 1.57 -1.5 speed 1 acceleration 0.5\n800 end\n");
  Started manual(folder_, "manual",
                 task({"--words", script, "--set", "robots.arm1.synchro=known_pose", "--set",
                       "robots.arm2.synchro=known_pose"}));
  ASSERT_TRUE(manual.await_line("s  arm1  move")) << manual.end().all();
  const ProcessId driver = manual.child("edp-arm1");
  long stops = 0;
  for (; driver.runs(); ++stops) {
    ::kill(driver.pid, SIGSTOP);
    std::this_thread::sleep_for(25ms);
    ::kill(driver.pid, SIGCONT);
    std::this_thread::sleep_for(150ms);
  }
  const Ended ended = manual.end();
  EXPECT_EQ(ended.status, 0) << ended.all();
  EXPECT_GT(stops, 20);
  EXPECT_LT(steps_passed_over("edp-arm1"), 4 * stops) << "of 12 steps of each stop";
}

}  // namespace
}  // namespace mrroc::test
