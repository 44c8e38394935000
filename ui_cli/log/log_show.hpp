// `ui_cli log show`: describes a run in words.
#pragma once
#include <iosfwd>
#include <limits>
#include <string>

#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Choice of what is shown of a run.
struct ShowOptions {
  std::string channel;  ///< every message of this channel instead of the story of the run; empty: the story
  double from{0};       ///< simulated time [s]
  double to{std::numeric_limits<double>::infinity()};  ///< the same, inclusive [s]
  bool changes{};  ///< only what changes: behaviours, states, the operator, faults, messages of processes
  bool json{};     ///< an object per line
};

/// Prints a line per macrostep, and one per change of behaviour or state, order of the operator, refusal and line of a
/// process, and at last how the run ended (when `to` is left open); or a line per message of one channel.
/// @param err  gets a warning where names of behaviours cannot be read
/// @throws FaultError bad_usage: there is no such channel
void show_log(const RunRecord& run, const ShowOptions& options, std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
