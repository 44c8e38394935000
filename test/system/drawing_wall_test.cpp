// The wall clock: whoever is not scheduled for a while goes on, and the task comes to its end.
#include <gtest/gtest.h>
#include <csignal>

#include <fstream>
#include <iterator>
#include <thread>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class WallClock : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers cannot keep to the clock";
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }
  std::vector<std::string> task() {
    return {"--processes", "separate",
            "--clock",     "wall",
            "--drawing",   folder_.write("line.svg", lines_svg(1)),
            "--size",      "12",
            "--run-dir",   (folder_ / "run").string()};
  }
  static void stop_for(const ProcessId& process, std::chrono::milliseconds time) {
    ::kill(process.pid, SIGSTOP);
    std::this_thread::sleep_for(time);
    ::kill(process.pid, SIGCONT);
  }
  Folder folder_;
};

TEST_F(WallClock, ATaskComesToItsEndThoughItsProcessesAreStoppedForAWhile) {
  Started drawing(folder_, "drawing", task());
  ASSERT_TRUE(drawing.await_line("m = 2  record")) << drawing.end().all();
  for (const char* const part : {"edp-arm1", "ecp-arm1", "vsp-arm1", "simulator"}) {
    stop_for(drawing.child(part), 100ms);
    std::this_thread::sleep_for(200ms);
  }
  ASSERT_TRUE(drawing.await_line("m = 5  draw on the paper")) << drawing.end().all();
  for (const char* const part : {"edp-arm2", "ecp-arm2", "vsp-arm2", "simulator"}) {
    stop_for(drawing.child(part), 100ms);
    std::this_thread::sleep_for(200ms);
  }
  const Ended end = drawing.end();
  EXPECT_EQ(end.status, 0) << end.all();
  EXPECT_EQ(summary(folder_ / "run")["outcome"], "done");
  EXPECT_NE(text_of(folder_ / "run" / "messages.log").find("skipped"), std::string::npos);
}

TEST_F(WallClock, AnAgentThatIsAwayForLongerMakesTheArmsHoldAndGoesOn) {
  Started drawing(folder_, "drawing", task());
  ASSERT_TRUE(drawing.await_line("m = 2  record")) << drawing.end().all();
  stop_for(drawing.child("ecp-arm2"), 600ms);
  const Ended end = drawing.end();
  EXPECT_EQ(end.status, 0) << end.all();
  EXPECT_NE(text_of(folder_ / "run" / "messages.log").find("the arm comes to rest"), std::string::npos);
}

TEST_F(WallClock, ASimulatorThatStaysAwayIsANamedFault) {
  Started drawing(folder_, "drawing", task());
  ASSERT_TRUE(drawing.await_line("m = 2  record")) << drawing.end().all();
  stop_for(drawing.child("simulator"), 2000ms);
  const Ended end = drawing.end();
  EXPECT_EQ(end.status, 3) << end.all();
  EXPECT_TRUE(end.last_err().starts_with("error: hardware_silent: ")) << end.last_err();
}

}  // namespace
}  // namespace mrroc::test
