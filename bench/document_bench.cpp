// Which of the documents' commands the tests run.
#include <fmt/format.h>

#include <algorithm>

#include "bench/operator_figures.hpp"
#include "test/docs/commands.hpp"

namespace mrroc::bench {

Figures document_figures() {
  const auto commands = test::document_commands(MRROC_SOURCE_DIR);
  const auto trials = test::read_trials(MRROC_SOURCE_DIR);
  const auto run = std::ranges::count_if(
      commands, [&](const test::Command& c) { return test::trial_of(trials, c.text).not_run.empty(); });
  return {{"doc_commands_run", 100.0 * static_cast<double>(run) / static_cast<double>(commands.size()), "%",
           fmt::format("{} of {} commands in README.md and docs/ are run by the tests, wanted 100", run,
                       commands.size())}};
}

}  // namespace mrroc::bench
