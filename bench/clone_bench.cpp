// How long a person waits for the compiler: from a fresh clone to a moving arm, and after a change in a task.
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "base/fault.hpp"
#include "bench/operator_figures.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

/// Sources without a repository, such as an unpacked archive, are copied: $1 sources, $2 clone.
constexpr const char* kClone = R"sh(
git clone -q "$1" "$2" 2>/dev/null && exit
mkdir "$2" && tar -C "$1" --exclude=./build --exclude=./runs -c . | tar -C "$2" -x
)sh";

}  // namespace

Figures clone_figures() {
  ::setenv("CCACHE_DISABLE", "1", 1);
  const ScratchFolder scratch;
  const fs::path clone = scratch.path() / "mrroc";
  auto begun = Clock::now();
  TaskProcess git("/bin/bash", {"-c", kClone, "clone", MRROC_SOURCE_DIR, clone.string()});
  if (git.wait() != 0) throw FaultError(FaultCode::cannot_write, "cannot clone " MRROC_SOURCE_DIR);
  TaskProcess press((clone / "run").string(),
                    {"press", "--speed", "1", "--run-dir", (scratch.path() / "run").string()});
  const bool moves = press.read_until("m = 1  approach");
  const double moving_s = seconds_since(begun);
  press.wait();
  if (!moves) throw FaultError(FaultCode::start_failed, "./run press did not come to a moving arm");

  std::ofstream(clone / "tasks/press/press.cpp", std::ios::app) << "static_assert(sizeof(int) > 1);\n";
  begun = Clock::now();
  TaskProcess cmake("/usr/bin/env",
                    {"cmake", "--build", (clone / "build/release").string(), "--target", "press"});
  const bool built = cmake.wait() == 0;
  const double rebuild_s = seconds_since(begun);
  ::unsetenv("CCACHE_DISABLE");
  if (!built) throw FaultError(FaultCode::start_failed, "the clone does not build after a change");
  return {
      {"rebuild_s", rebuild_s, "s",
       "what press starts after a line was added to tasks/press/press.cpp, without ccache, wanted <= 20"},
      {"fresh_clone_s", moving_s, "s",
       "git clone and ./run press until it tells that the arm approaches; without ccache, Debian's packages "
       "were there"}};
}

}  // namespace mrroc::bench
