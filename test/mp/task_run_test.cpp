// How long macrosteps last when nothing but a person can go on.
#include "mp/task_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

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

  TaskRun& begin(const std::filesystem::path& script = {}) {
    TaskOptions options;
    options.separate = false;
    options.script = script;
    return run_.emplace("test", options, folder_, std::vector<std::string>{"arm1"}, std::vector<Part>{});
  }
  /// Macrosteps of that length. @return wall time that they took [s]
  double macrosteps(int count, double macrostep_s) {
    const auto begun = Clock::now();
    for (int k = 0; k < count; ++k) {
      std::ignore = run_->desk().take(++i_);
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
  ASSERT_TRUE(run.desk().give(OperatorOrder::start));
  std::ignore = run.desk().take(++i_);
  run.set_state(TaskState::running, false);
  EXPECT_LT(long_time(), kSoon);
}

TEST_F(Pacing, MacrostepsLastTheirTimeInAPause) {
  TaskRun& run = begin();
  run.set_state(TaskState::running, false);
  ASSERT_TRUE(run.desk().give(OperatorOrder::pause));
  std::ignore = run.desk().take(++i_);
  run.set_state(TaskState::paused, false);
  EXPECT_GE(short_time(), kShort);
  ASSERT_TRUE(run.desk().give(OperatorOrder::resume));
  EXPECT_LT(long_time(), kSoon);
}

TEST_F(Pacing, MacrostepsLastTheirTimeWhileOnlyATriggerIsMissing) {
  TaskRun& run = begin();
  run.desk().set_behaviour(2);
  run.set_state(TaskState::running, true);
  EXPECT_LT(long_time(), kSoon) << "there is something to be done before it";
  run.desk().set_trigger_due(true);
  EXPECT_GE(short_time(), kShort);
  ASSERT_TRUE(run.desk().give(OperatorOrder::trigger));
  EXPECT_LT(macrosteps(1, 1000), kSoon);
  run.desk().set_behaviour(3);
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
  ASSERT_TRUE(run_->desk().give(OperatorOrder::stop));
  EXPECT_LT(long_time(), kSoon);
}

}  // namespace
}  // namespace mrroc::mp
