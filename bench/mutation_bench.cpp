// Measures how good the tests are: test/mutation/mutation.py over a sample of all areas.
#include <fmt/core.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "base/fault.hpp"
#include "base/program.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {

Figures run_mutation_group(bool resume) {
  const ScratchFolder scratch;
  const std::filesystem::path json = scratch.path() / "summary.json";
  std::vector<std::string> words{"python3", fmt::format("{}/test/mutation/mutation.py", MRROC_SOURCE_DIR),
                                 "--build", program_folder().parent_path().string(),
                                 "--jobs",  std::to_string(std::max(1U, std::thread::hardware_concurrency())),
                                 "--json",  json.string()};
  if (resume) words.emplace_back("--resume");
  TaskProcess tool("/usr/bin/env", words);
  for (std::string line; tool.read_until("", &line);) fmt::print(stderr, "{}\n", line);
  if (tool.wait() != 0)
    throw FaultError(FaultCode::start_failed, "test/mutation/mutation.py has failed",
                     "look at the lines above");
  Figures figures;
  const nlohmann::json summary = needed_summary(scratch.path());
  for (const auto& [key, value] : summary.at("figures").items())
    figures.push_back({key, value.get<double>(), "%", "small errors that a fast test notices, of a sample"});
  return figures;
}

}  // namespace mrroc::bench
