// Any process may die: everything ends, both arms come to rest, and the user reads why.
#include <gtest/gtest.h>
#include <csignal>

#include <thread>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

enum class Moment { teaching, reproducing };

/// A task of separate processes in the middle of a long stroke.
class InAStroke {
 public:
  explicit InAStroke(Moment moment) : task_(folder_, "drawing", arguments(moment)) {
    in_it_ = task_.await_line(moment == Moment::teaching ? "m = 2  record" : "m = 5  draw on the paper");
    children_ = task_.children();
    // The pen rests at first where it has touched; a pace of 3 leaves seconds until the stroke's end.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }

  [[nodiscard]] bool in_it() const { return in_it_ && children_.size() == 7; }
  Started& task() { return task_; }
  [[nodiscard]] const std::vector<ProcessId>& children() const { return children_; }
  [[nodiscard]] nlohmann::json summary() const { return test::summary(folder_ / "run"); }
  [[nodiscard]] std::string last_line() const { return "run folder: " + (folder_ / "run").string(); }

 private:
  std::vector<std::string> arguments(Moment moment) {
    const std::string svg = folder_.write("line.svg", lines_svg(1));
    const std::vector<std::string> common{"--processes", "separate", "--run-dir", (folder_ / "run").string(),
                                          "--speed",     "3",        "--set",     "sim.hand.speed=0.01"};
    if (moment == Moment::teaching) return words({common, {"--drawing", svg, "--size", "60"}});
    const std::string taught = (folder_ / "line.recording").string();
    const auto teach = run(folder_, "drawing",
                           {"--processes", "one", "--drawing", svg, "--size", "60", "--save", taught, "--set",
                            "sim.hand.speed=0.01", "--run-dir", (folder_ / "teach").string()});
    EXPECT_EQ(teach.status, 0) << teach.all();
    return words({common, {"--load", taught}});
  }

  Folder folder_;
  Started task_;
  bool in_it_{};
  std::vector<ProcessId> children_;
};

bool can_run() { return !kSanitized && multicast(); }

struct Death {
  const char* part;
  Moment moment;
};

class KilledProcess : public ::testing::TestWithParam<Death> {};

TEST_P(KilledProcess, EndsTheSystemWithBothArmsAtRest) {
  if (!can_run()) GTEST_SKIP() << "no multicast, or too slow";
  const std::string part = GetParam().part;
  InAStroke run(GetParam().moment);
  ASSERT_TRUE(run.in_it()) << run.task().end().all();
  ::kill(run.task().child(part).pid, SIGKILL);
  const Ended end = run.task().end();
  EXPECT_EQ(end.status, 3) << end.all();
  EXPECT_TRUE(end.last_err().starts_with("error: process_died: ")) << end.last_err();
  EXPECT_NE(end.last_err().find(part), std::string::npos) << end.last_err();
  EXPECT_EQ(end.last_out(), run.last_line());
  EXPECT_TRUE(all_gone(run.children()));
  const auto summary = run.summary();
  EXPECT_EQ(summary.at("outcome"), "fault");
  EXPECT_EQ(summary.at("fault").at("class"), "system");
  EXPECT_EQ(summary.at("fault").at("code"), "process_died");
  EXPECT_EQ(summary.at("fault").at("process"), part);
  if (part == "simulator") return;  // arms that are gone come to no rest
  ASSERT_TRUE(summary.at("figures").contains("stop_steps_max")) << summary;
  EXPECT_LE(summary.at("figures").at("stop_steps_max").get<double>(), 100);
}

constexpr Death kDeaths[]{
    {"simulator", Moment::teaching},   {"edp-arm1", Moment::teaching},     {"edp-arm2", Moment::teaching},
    {"ecp-arm1", Moment::teaching},    {"ecp-arm2", Moment::teaching},     {"vsp-arm1", Moment::teaching},
    {"vsp-arm2", Moment::teaching},    {"simulator", Moment::reproducing}, {"edp-arm1", Moment::reproducing},
    {"edp-arm2", Moment::reproducing}, {"ecp-arm1", Moment::reproducing},  {"ecp-arm2", Moment::reproducing},
    {"vsp-arm1", Moment::reproducing}, {"vsp-arm2", Moment::reproducing},
};
std::string name_of(const ::testing::TestParamInfo<Death>& death) {
  std::string name = death.param.part;
  std::erase(name, '-');
  return name + (death.param.moment == Moment::teaching ? "Teaching" : "Reproducing");
}
INSTANTIATE_TEST_SUITE_P(Matrix, KilledProcess, ::testing::ValuesIn(kDeaths), name_of);

TEST(KilledParent, TakesItsChildrenAlong) {
  if (!can_run()) GTEST_SKIP() << "no multicast, or too slow";
  InAStroke run(Moment::teaching);
  ASSERT_TRUE(run.in_it());
  run.task().signal(SIGKILL);
  EXPECT_EQ(run.task().end().status, 128 + SIGKILL);
  EXPECT_TRUE(all_gone(run.children()));
}

TEST(HungProcess, IsDeclaredDead) {
  if (!can_run()) GTEST_SKIP() << "no multicast, or too slow";
  InAStroke run(Moment::teaching);
  ASSERT_TRUE(run.in_it());
  ::kill(run.task().child("vsp-arm1").pid, SIGSTOP);
  const Ended end = run.task().end();
  EXPECT_EQ(end.status, 3) << end.all();
  EXPECT_TRUE(end.last_err().starts_with("error: process_hung: ")) << end.last_err();
  EXPECT_EQ(run.summary()["fault"]["process"], "vsp-arm1");
  EXPECT_LE(run.summary()["figures"]["stop_steps_max"].get<double>(), 100);
  EXPECT_TRUE(all_gone(run.children()));
}

TEST(HungProcess, IsNoneOfThoseThatSleepWithTheirHost) {
  if (!can_run()) GTEST_SKIP() << "no multicast, or too slow";
  InAStroke run(Moment::teaching);
  ASSERT_TRUE(run.in_it());
  const auto all = [&](int signal) {
    run.task().signal(signal);
    for (const ProcessId& process : run.children()) ::kill(process.pid, signal);
  };
  all(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(11));  // a process that says nothing for 10 s hangs
  all(SIGCONT);
  const Ended end = run.task().end();
  EXPECT_EQ(end.status, 0) << end.all();
  EXPECT_EQ(run.summary()["outcome"], "done");
}

TEST(Interrupt, StopsTheTask) {
  if (!can_run()) GTEST_SKIP() << "no multicast, or too slow";
  InAStroke run(Moment::teaching);
  ASSERT_TRUE(run.in_it());
  run.task().signal(SIGINT);
  const Ended end = run.task().end();
  EXPECT_EQ(end.status, 1) << end.all();
  EXPECT_TRUE(end.last_err().starts_with("error: interrupted: a signal ended the task (SIGINT)"))
      << end.last_err();
  EXPECT_EQ(end.last_out(), run.last_line());
  EXPECT_EQ(run.summary()["outcome"], "stopped");
  EXPECT_LE(run.summary()["figures"]["stop_steps_max"].get<double>(), 100);
  EXPECT_TRUE(all_gone(run.children()));
}

}  // namespace
}  // namespace mrroc::test
