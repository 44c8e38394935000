// Programs that the benchmark watches: their lines, and that a silent one does not hang it.
#include "bench/task_process.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "base/fault.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using bench::TaskProcess;

TEST(TaskProcess, GivesLinesAndTheExitStatus) {
  TaskProcess p("/bin/sh", {"-c", "echo one; echo two; echo three; exit 3"});
  std::string line;
  EXPECT_TRUE(p.read_until("w", &line));
  EXPECT_EQ(line, "two");
  EXPECT_FALSE(p.read_until("four"));
  EXPECT_EQ(p.wait(), 3);
}

TEST(TaskProcess, ASilentProgramIsEndedAndNamed) {
  for (const char* script : {"exec sleep 100", "exec >&-; exec sleep 100"}) {
    TaskProcess p("/bin/sh", {"-c", script}, 200ms);
    const pid_t pid = p.pid();
    try {
      p.wait();
      ADD_FAILURE() << "must not wait for ever: " << script;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
      EXPECT_NE(std::string(e.what()).find("sh"), std::string::npos) << e.what();
    }
    EXPECT_NE(::kill(pid, 0), 0) << "it is gone";
  }
}

}  // namespace
}  // namespace mrroc::test
