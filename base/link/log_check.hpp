// Recomputes what a process of a logged run sent, from what it received (x_c gives y_c, MG 6): the same program
// runs again on the log, with the same transition functions, and every message must be the same in every bit.
#pragma once
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "base/link/process.hpp"
#include "base/link/replay_bus.hpp"

namespace mrroc::link {

/// Result of the check of one process.
struct LogVerdict {
  std::string process{};                 ///< its name
  std::int64_t compared{};               ///< messages that were recomputed
  std::int64_t differences{};            ///< of these, those that differ, and those that were not sent again
  std::optional<LogDifference> first{};  ///< the first difference
  std::string incomplete{};              ///< why the check did not come to the end of the log; empty: it did
  std::string not_checked{};             ///< why this process cannot be checked at all; empty: it can
};

/// Runs a process on the log of a run.
/// @param name      of the process in that run; the rest of its context is taken from the log
/// @param clock     of the run: with the wall clock it is not known what had arrived when a process decided, so
///                  there is nothing to check
/// @param body      what the process does, as link::NodeMain
/// @param left_out  channels without the session that it is not to hear
[[nodiscard]] LogVerdict check_process(const LogReader& log, const std::string& name, ClockKind clock,
                                       const std::function<void(Process&)>& body,
                                       const std::set<std::string>& left_out = {});

/// @return the verdict as one line of JSON, for `ui_cli log check`
[[nodiscard]] std::string to_json(const LogVerdict& verdict);
/// @throws FaultError bad_log when the text is none
[[nodiscard]] LogVerdict verdict_from_json(const std::string& text);

/// Prints the verdict as JSON. @return exit status: 1 when there are differences, otherwise 0
int report_verdict(const LogVerdict& verdict);

}  // namespace mrroc::link
