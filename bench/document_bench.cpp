// Counts how many of the documents' commands work: runs their test.
#include <fmt/core.h>

#include <sstream>

#include "base/fault.hpp"
#include "bench/operator_figures.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {

Figures document_figures() {
  int all = 0, well = 0, stand_ins = 0;
  TaskProcess test("test_doc_commands", {"--gtest_brief=1"});
  for (std::string line; test.read_until("command: ", &line);) {
    std::istringstream words(line);
    std::string mark, result, how;
    words >> mark >> result >> how;
    ++all;
    well += result == "ok";
    stand_ins += result == "ok" && how == "stand-in,";
  }
  test.wait();
  if (all == 0) throw FaultError(FaultCode::start_failed, "test_doc_commands has told nothing");
  const auto share = [all](int count) { return 100.0 * count / all; };
  return {{"doc_commands_run", share(well), "%",
           fmt::format("{} of {} commands in README.md and docs/ ended well, wanted 100", well, all)},
          {"doc_commands_as_they_stand", share(well - stand_ins), "%",
           fmt::format("without {} that the test types with a stand-in", stand_ins)}};
}

}  // namespace mrroc::bench
