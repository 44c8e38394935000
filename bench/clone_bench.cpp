// Measures the time that a person waits for the compiler: from a fresh clone to a moving arm, and after a
// change in a task or in the effector driver.
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

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

/// Adds a line to a source file and builds what press starts. @return how long that took [s]
double rebuild_after_change_of(const char* file, const fs::path& clone) {
  std::ofstream(clone / file, std::ios::app) << "static_assert(sizeof(int) > 1);\n";
  const auto begun = Clock::now();
  TaskProcess cmake("/usr/bin/env",
                    {"cmake", "--build", (clone / "build/release").string(), "--target", "press"});
  const bool built = cmake.wait() == 0;
  const double duration = seconds_since(begun);
  if (!built)
    throw FaultError(FaultCode::start_failed,
                     std::string("the clone does not build after a change of ") + file);
  return duration;
}

}  // namespace

Figures clone_figures() {
  ::setenv("CCACHE_DISABLE", "1", 1);
  const ScratchFolder scratch;
  const fs::path clone = scratch.path() / "mrroc";
  const auto begun = Clock::now();
  TaskProcess git("/bin/bash", {"-c", kClone, "clone", MRROC_SOURCE_DIR, clone.string()});
  if (git.wait() != 0) throw FaultError(FaultCode::cannot_write, "cannot clone " MRROC_SOURCE_DIR);
  TaskProcess press((clone / "run").string(),
                    {"press", "--speed", "1", "--run-dir", (scratch.path() / "run").string()});
  const bool moves = press.read_until("m = 1  approach");
  const double moving_s = seconds_since(begun);
  press.wait();
  if (!moves) throw FaultError(FaultCode::start_failed, "./run press did not come to a moving arm");

  const double rebuild_s = rebuild_after_change_of("tasks/press/press.cpp", clone);
  const double driver_rebuild_s = rebuild_after_change_of("edp/driver.hpp", clone);
  ::unsetenv("CCACHE_DISABLE");
  return {
      {"rebuild_s", rebuild_s, "s",
       "what press starts after a line was added to tasks/press/press.cpp, without ccache, wanted <= 20"},
      {"driver_rebuild_s", driver_rebuild_s, "s", "the same after a line was added to edp/driver.hpp"},
      {"fresh_clone_s", moving_s, "s",
       "git clone and ./run press until it tells that the arm approaches; without ccache, Debian's packages "
       "were there"}};
}

}  // namespace mrroc::bench
