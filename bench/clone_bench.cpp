// How long a person waits for the compiler: after a change in a task, and from a fresh clone to a moving arm.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "base/fault.hpp"
#include "bench/operator_figures.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Sources and build are covered by layers that vanish with this shell: what is changed and built here, nobody else
/// sees. $1 sources, $2 build.
constexpr const char* kRebuild = R"sh(
set -e
layers=$(mktemp -d)
trap 'rmdir "$layers"' EXIT
mount -t tmpfs layers "$layers"
trap 'umount -l "$layers"; rmdir "$layers"' EXIT
cover() {
  mkdir "$layers/$2" "$layers/$2.work"
  mount -t overlay "$2" -o "lowerdir=$1,upperdir=$layers/$2,workdir=$layers/$2.work" "$1"
}
cover "$1" sources
case $2 in "$1"/*) ;; *) cover "$2" build ;; esac
cd "$1"
cmake --build "$2" --target programs >/dev/null
echo 'static_assert(sizeof(int) > 1);' >>tasks/press/press.cpp
begun=$(date +%s%N)
cmake --build "$2" --target programs >/dev/null
echo "rebuilt $((($(date +%s%N) - begun) / 1000000))"
)sh";

}  // namespace

Figures rebuild_figures() {
  ::setenv("CCACHE_DISABLE", "1", 1);
  const fs::path build = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  TaskProcess shell("/usr/bin/unshare", {::geteuid() == 0 ? "-m" : "-rm", "/bin/bash", "-c", kRebuild,
                                         "rebuild", MRROC_SOURCE_DIR, build.string()});
  std::string line;
  const bool built = shell.read_until("rebuilt ", &line);
  shell.wait();
  ::unsetenv("CCACHE_DISABLE");
  if (!built) {
    std::fputs("rebuild_s is not measured: this host gives no layers over folders (unshare, overlay)\n",
               stderr);
    return {};
  }
  return {{"rebuild_s", std::stod(line.substr(line.rfind(' '))) / 1000, "s",
           "all programs after a line was added to tasks/press/press.cpp, without ccache, wanted <= 20"}};
}

Figures run_fresh_clone_group() {
  ::setenv("CCACHE_DISABLE", "1", 1);
  const ScratchFolder scratch;
  const fs::path clone = scratch.path() / "mrroc";
  const auto begun = Clock::now();
  TaskProcess git("/usr/bin/git", {"clone", "-q", MRROC_SOURCE_DIR, clone.string()});
  if (git.wait() != 0) throw FaultError(FaultCode::cannot_write, "git cannot clone " MRROC_SOURCE_DIR);
  TaskProcess press((clone / "run").string(),
                    {"press", "--speed", "1", "--run-dir", (scratch.path() / "run").string()});
  const bool moves = press.read_until("m = 1  approach");
  const double moving_s = std::chrono::duration<double>(Clock::now() - begun).count();
  press.wait();
  if (!moves) throw FaultError(FaultCode::start_failed, "./run press did not come to a moving arm");
  return {{"fresh_clone_s", moving_s, "s",
           "git clone, ./run press until the arm moves; without ccache, Debian's packages were there"}};
}

}  // namespace mrroc::bench
