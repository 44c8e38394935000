// Actions of a run in its macrosteps, and at its end.
#include "mp/task_run.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string_view>
#include <thread>

#include "mp/gnuplot.hpp"
#include "mp/pictures.hpp"

namespace mrroc::mp {
namespace {

using Clock = std::chrono::steady_clock;

/// A run without any other process, all in this thread. Its macrosteps are given by the test.
class Pacing : public ::testing::Test {
 protected:
  Pacing() {
    std::filesystem::create_directories(folder_);
    write_text(folder_ / "config.toml", "");
  }
  ~Pacing() override { std::filesystem::remove_all(folder_); }

  TaskRun& begin(const std::filesystem::path& script = {}, double max_time = 0) {
    TaskOptions options;
    options.max_time = max_time;
    options.separate = false;
    options.script = script;
    return run_.emplace("test", options, folder_, std::vector<std::string>{"arm1"}, std::vector<NodeSpec>{});
  }
  /// Macrosteps of that length. @return wall time that they took [s]
  double macrosteps(int count, double macrostep_s) {
    const auto begun = Clock::now();
    for (int k = 0; k < count; ++k) {
      std::ignore = run_->command_server().take(++i_);
      t_ += macrostep_s;
      run_->each_macrostep(i_, t_);
    }
    return std::chrono::duration<double>(Clock::now() - begun).count();
  }
  /// A quarter of an hour of simulated time that is not waited for; the first macrostep still may be.
  double long_time() { return macrosteps(3, 0.01) + macrosteps(100, 10); }
  double short_time() { return macrosteps(4, 0.05); }

  static constexpr double kShort = 0.15;  // what short_time() lasts in real time, at the least
  static constexpr double kSoon = 100;    // of long_time(): a tenth of real time

  std::filesystem::path folder_{std::filesystem::temp_directory_path() /
                                ("task_run_test." + std::to_string(::getpid()))};
  std::optional<TaskRun> run_;
  std::int64_t i_{};
  double t_{};
};

TEST_F(Pacing, MacrostepsLastTheirTimeUntilStartIsGivenAndNoLonger) {
  TaskRun& run = begin();
  run.set_state(TaskState::waiting_for_start, false);
  EXPECT_GE(short_time(), kShort);
  ASSERT_TRUE(run.command_server().give(OperatorOrder::start));
  std::ignore = run.command_server().take(++i_);
  run.set_state(TaskState::running, false);
  EXPECT_LT(long_time(), kSoon);
}

TEST_F(Pacing, MacrostepsLastTheirTimeInAPause) {
  TaskRun& run = begin();
  run.set_state(TaskState::running, false);
  ASSERT_TRUE(run.command_server().give(OperatorOrder::pause));
  std::ignore = run.command_server().take(++i_);
  run.set_state(TaskState::paused, false);
  EXPECT_GE(short_time(), kShort);
  ASSERT_TRUE(run.command_server().give(OperatorOrder::resume));
  EXPECT_LT(long_time(), kSoon);
}

TEST_F(Pacing, MacrostepsLastTheirTimeWhileOnlyATriggerIsMissing) {
  TaskRun& run = begin();
  run.command_server().set_behaviour(2);
  run.set_state(TaskState::running, true);
  EXPECT_LT(long_time(), kSoon) << "there is something to be done before it";
  run.command_server().set_trigger_due(true);
  EXPECT_GE(short_time(), kShort);
  ASSERT_TRUE(run.command_server().give(OperatorOrder::trigger));
  EXPECT_LT(macrosteps(1, 1000), kSoon);
  run.command_server().set_behaviour(3);
  EXPECT_LT(long_time(), kSoon) << "the next behaviour has its own";
}

TEST_F(Pacing, AScriptOrAStopDoesNotWait) {
  write_text(folder_ / "script", "100000 start\n");
  begin(folder_ / "script").set_state(TaskState::waiting_for_start, false);
  EXPECT_LT(long_time(), kSoon);
  run_.reset();
  i_ = 0;
  t_ = 0;
  begin().set_state(TaskState::waiting_for_start, false);
  ASSERT_TRUE(run_->command_server().give(OperatorOrder::stop));
  EXPECT_LT(long_time(), kSoon);
}

TEST_F(Pacing, ARunEndsWhenItsSimulatedTimeIsOverAndNotBefore) {
  TaskRun& run = begin({}, 2.0);
  run.set_state(TaskState::running, false);
  run.board().set_behaviour(3, "lead to the start", "the operator's trigger");
  macrosteps(199, 0.01);
  EXPECT_FALSE(run.supervisor().fault());
  macrosteps(1, 0.011);
  ASSERT_TRUE(run.supervisor().fault());
  EXPECT_EQ(run.supervisor().fault()->code, FaultCode::time_limit);
  EXPECT_EQ(run.supervisor().fault()->text.view(),
            "2 s; m = 3, lead to the start, goes on until: the operator's trigger");
  run.process().poll();
  EXPECT_EQ(run.process().phase(), link::Phase::stopping);
  EXPECT_GT(run.process().stop_as_of(), i_) << "in a macrostep on which all can agree";
}

TEST_F(Pacing, ARunWithoutALimitDoesNotEndByItself) {
  TaskRun& run = begin();
  run.set_state(TaskState::running, false);
  macrosteps(100, 1000);
  EXPECT_FALSE(run.supervisor().fault());
}

TEST_F(Pacing, ARecoverableFaultDoesNotWaitForTheBlackBoxOfTheOneBefore) {
  TaskRun& run = begin();
  run.set_state(TaskState::running, false);
  macrosteps(1, 0.01);
  run.process().log("something for the log");
  run.process().poll();
  const std::filesystem::path first = folder_ / "black_box" / "edp-arm1-1" / "mp.txt";
  std::filesystem::create_directories(first.parent_path());
  ASSERT_EQ(::mkfifo(first.c_str(), 0600), 0);  // who writes to it waits for a reader
  const Fault fault{.code = FaultCode::over_current, .process = "edp-arm1"};
  run.report_recoverable_fault(fault, "go on");
  std::thread reader([&] {
    std::this_thread::sleep_for(std::chrono::seconds(2));
    std::ifstream(first).ignore(std::numeric_limits<std::streamsize>::max());
  });
  macrosteps(1, 0.01);
  const auto before = Clock::now();
  run.report_recoverable_fault(fault, "go on");
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(1));
  reader.join();
  run.process().poll();
  const Summary summary = run.end(Outcome::aborted, fault);
  EXPECT_TRUE(std::ranges::count(summary.black_box, "black_box/edp-arm1-2/mp.txt")) << "written all the same";
}

TEST_F(Pacing, CtrlZInLockStepSuspendsAndSaysSo) {
  int out[2];
  ASSERT_EQ(::pipe(out), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(20);
    ::dup2(out[1], STDOUT_FILENO);
    TaskRun& run = begin();
    ::raise(SIGTSTP);
    run.process().poll();
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, WUNTRACED), child);
  EXPECT_TRUE(WIFSTOPPED(status));
  std::array<char, 200> told{};
  ASSERT_GT(::read(out[0], told.data(), told.size() - 1), 0);
  EXPECT_TRUE(std::string_view(told.data()).starts_with("suspended")) << told.data();
  ::kill(child, SIGCONT);
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "it went on";
  for (const int end : out) ::close(end);
}

/// A gnuplot that hangs, and that Ctrl-C alone does not end.
class HangingGnuplot : public Pacing {
 protected:
  HangingGnuplot() {
    std::filesystem::create_directories(folder_ / "plots");
    write_text(folder_ / "gnuplot", "#!/bin/sh\ntrap '' INT TERM HUP\necho >>plots/begun\nexec sleep 60\n");
    std::filesystem::permissions(folder_ / "gnuplot", std::filesystem::perms::owner_all);
    ::setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  }
  ~HangingGnuplot() override { ::setenv("PATH", path_.c_str(), 1); }
  bool begun() const { return std::filesystem::exists(folder_ / "plots" / "begun"); }

 private:
  std::string path_{std::getenv("PATH")};
};

TEST_F(HangingGnuplot, IsKilledByASignalAndNoPictureFollows) {
  TaskRun& run = begin();
  const auto before = Clock::now();
  std::thread person([&] {
    while (!begun()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(::getpid(), SIGINT);
  });
  ::testing::internal::CaptureStdout();
  bool table = false;
  run.finish([&] {
    draw(folder_, {{"a", ""}, {"b", ""}});
    table = true;
  });
  person.join();
  const std::string told = ::testing::internal::GetCapturedStdout();
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(20));
  EXPECT_TRUE(table) << "the other work goes on";
  EXPECT_EQ(std::filesystem::file_size(folder_ / "plots" / "begun"), 1U) << "gnuplot ran once";
  EXPECT_NE(told.find("gnuplot is killed"), std::string::npos) << told;
  EXPECT_NE(told.find("a.png and what follows are not drawn"), std::string::npos) << told;
}

TEST_F(HangingGnuplot, OtherWorkThatHangsIsEndedByFurtherSignals) {
  const auto hang = [&] {
    std::signal(SIGALRM, SIG_DFL);
    ::alarm(20);
    TaskRun& run = begin();
    run.finish([] {
      for (int k = 0; k < 60; ++k) {
        ::kill(::getpid(), SIGINT);
        std::this_thread::sleep_for(std::chrono::seconds(1));
      }
    });
  };
  EXPECT_EXIT(hang(), ::testing::ExitedWithCode(exit_status(FaultCode::interrupted)), "");
}

TEST_F(HangingGnuplot, TheNextRunDrawsAgain) {
  allow_gnuplot(false);
  EXPECT_EQ(run_gnuplot(folder_, "plots/a.gp"), GnuplotResult::stopped);
  write_text(folder_ / "gnuplot", "#!/bin/sh\nexit 0\n");
  auto result = GnuplotResult::failed;
  begin().finish([&] { result = run_gnuplot(folder_, "plots/a.gp"); });
  EXPECT_EQ(result, GnuplotResult::done);
}

}  // namespace
}  // namespace mrroc::mp
