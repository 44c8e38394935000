// Lines of progress of a task whose coordinator has behaviours of its own.
#include "mp/coordinated_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/msg/convert.hpp"
#include "base/text_file.hpp"
#include "test/mp/coordinator_rig.hpp"
#include "test/mp/two_arms.hpp"

namespace mrroc::mp {
namespace {

/// @return how often a text has that line's end
int count(const std::string& text, const std::string& what) {
  int found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(CoordinatedRun, AnnouncesABehaviourWhenItBeginsAndNotInEachOfItsMacrosteps) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("coordinated_run_test." + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  write_text_file(folder / "config.toml", "");
  TaskOptions options;
  options.separate = false;
  ::testing::internal::CaptureStdout();
  {
    TaskRun run("test", options, folder, {}, {});
    CoordinatedLinks links(run, {});
    for (const int m : {1, 1, 1, 2, 2, 1, 1}) links.observe(m, m == 1 ? "press" : "let go", "", {});
    EXPECT_EQ(run.board().m(), 1);
  }
  const std::string told = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(count(told, "m = 1  press"), 2) << told;
  EXPECT_EQ(count(told, "m = 2  let go"), 1) << told;
  std::filesystem::remove_all(folder);
}

/// A coordinator's links in this thread, with nobody at their other ends.
class CoordinatedLinksTest : public CoordinatorRig {
 protected:
  CoordinatedLinksTest() { links.emplace(*run, CoordinatedParameters{.arms = arms, .n_s = 25}); }

  std::optional<CoordinatedLinks> links;
};

TEST_F(CoordinatedLinksTest, TheFirstBehaviourWaitsForTheStartAndTheOthersRun) {
  const std::vector<Report> reports(arms.size());
  for (const int m : {0, 1, 2, 0, 7}) {
    links->observe(m, "behaviour", "it ends", reports);
    EXPECT_EQ(run->command_server().needed(), m == 0 ? "start" : "") << m;
    if (m == 0) {
      EXPECT_FALSE(run->command_server().give(OperatorOrder::pause)) << "there is nothing to pause";
    }
    EXPECT_EQ(run->board().m(), m);
    EXPECT_EQ(run->board().behaviour(), "behaviour");
    EXPECT_EQ(run->board().until(), "it ends");
  }
  EXPECT_TRUE(run->command_server().give(OperatorOrder::pause));
}

TEST_F(CoordinatedLinksTest, TheEndIsToldToEveryArmWithACommandThatADriverCanExecute) {
  std::vector<std::unique_ptr<link::Inbox<agent_order_t>>> orders;
  for (const std::string& arm : arms) orders.push_back(process.inbox<agent_order_t>(arm + ".order"));
  links->finish();
  for (const auto& in : orders) {
    ASSERT_TRUE(in->newest());
    const Order order = from_message(*in->newest());
    EXPECT_TRUE(order.finished);
    EXPECT_EQ(order.m, 0);
    EXPECT_EQ(order.arm.n_s, 25);
    EXPECT_EQ(order.arm.n_Q, 24) << "the reply of the step before the last one";
  }
  EXPECT_EQ(run->board().progress(), 1);
}

TEST_F(CoordinatedLinksTest, TheFirstOrderIsACommandThatADriverCanExecute) {
  std::vector<std::unique_ptr<link::Inbox<agent_order_t>>> orders;
  for (const std::string& arm : arms) orders.push_back(process.inbox<agent_order_t>(arm + ".order"));
  report_all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  EXPECT_EQ(links->links().i(), 1);
  for (const auto& in : orders) {
    ASSERT_TRUE(in->newest());
    EXPECT_EQ(in->newest()->header.stamp, 1);
    const Order order = from_message(*in->newest());
    EXPECT_FALSE(order.finished);
    EXPECT_EQ(order.m, 0);
    EXPECT_EQ(order.arm.n_s, 25);
    EXPECT_EQ(order.arm.n_Q, 24) << "the reply of the step before the last one";
  }
}

TEST_F(CoordinatedLinksTest, ARunTakesNoteOfEveryMacrostepOfItsBehavioursAndTellsItsEnd) {
  using Run = CoordinatedRun<Two>;
  constexpr int kMacrosteps = 6;
  const auto program = [this](Two::X& x, Run::Port& port) {
    EXPECT_EQ(x.c, 42) << "it begins with its memory";
    EXPECT_EQ(x.i, 1) << "and with images";
    EXPECT_TRUE(x.T.agent[1].ready);
    Motion<Two> motion{};
    motion.m = 3;
    motion.name = "press";
    motion.until = "the force stands";
    for (int k = 0; k < kMacrosteps; ++k) {
      port.dispatch(motion, Two::Y{});
      report_all(x.i + 1);
      if (const Outcome o = port.wait(); o != Outcome::terminated) return o;
      port.read(x);
      EXPECT_EQ(run->board().m(), 3);
      EXPECT_EQ(run->board().behaviour(), "press");
      EXPECT_EQ(run->board().until(), "the force stands");
    }
    return Outcome::terminated;
  };
  Run coordinator(*run, CoordinatedParameters{.arms = arms, .n_s = 25}, 42, program);
  report_all(1);
  EXPECT_EQ(coordinator.execute(), Outcome::terminated);
  ASSERT_EQ(coordinator.traces().size(), arms.size());
  for (const ArmTrace& trace : coordinator.traces()) {
    ASSERT_EQ(trace.size(), static_cast<std::size_t>(kMacrosteps));
    for (std::size_t k = 0; k < trace.size(); ++k) EXPECT_EQ(trace[k].i, static_cast<std::int64_t>(k) + 2);
  }
  EXPECT_EQ(run->board().progress(), 1);
}

TEST_F(CoordinatedLinksTest, ARunThatEndsOtherwiseIsNotToldAsDone) {
  using Run = CoordinatedRun<Two>;
  std::vector<std::unique_ptr<Run>> runs;  // the bus knows all of them to the end
  for (const Outcome o : {Outcome::aborted, Outcome::faulted}) {
    runs.push_back(std::make_unique<Run>(*run, CoordinatedParameters{.arms = arms, .n_s = 25}, 0,
                                         [o](Two::X& /*x*/, Run::Port& /*port*/) { return o; }));
    report_all(1);
    EXPECT_EQ(runs.back()->execute(), o);
    EXPECT_NE(run->board().progress(), 1);
  }
}

}  // namespace
}  // namespace mrroc::mp
