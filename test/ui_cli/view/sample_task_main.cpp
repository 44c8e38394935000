// Something for the viewer to look at, without a world. Usage:
//   view_sample run FOLDER                   writes a run folder of 10 s
//   view_sample wild FOLDER                  writes one with numbers and texts that nobody tells
//   view_sample task FOLDER SESSION SECONDS  is a running task for so long, then prints the number of replies
//   view_sample beside SESSION               starts a viewer as a task does, prints its address
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "mp/viewer.hpp"
#include "test/ui_cli/view/sample_run.hpp"
#include "test/ui_cli/view/sample_task.hpp"

namespace {

void run_task(const std::string& folder, const std::string& session, double seconds) {
  using mrroc::test::SampleTask;
  SampleTask task(session, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(800));  // until a viewer has seen it
  auto next = std::chrono::steady_clock::now();
  while (static_cast<double>(task.steps()) < seconds * SampleTask::kPerSecond) {
    task.step();
    next += std::chrono::milliseconds(1000 / SampleTask::kPerSecond);
    std::this_thread::sleep_until(next);
  }
  std::printf("%lld\n", static_cast<long long>(2 * task.steps()));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "run" && argc == 3)
      mrroc::test::write_run(argv[2], 500);
    else if (what == "wild" && argc == 3)
      mrroc::test::write_wild_run(argv[2]);
    else if (what == "task" && argc == 5)
      run_task(argv[2], argv[3], std::stod(argv[4]));
    else if (what == "beside" && argc == 3)
      std::puts(mrroc::mp::start_viewer(argv[2]).c_str());
    else
      return 2;
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  }
}
