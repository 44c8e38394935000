// `ui_cli log compare`: where two runs part.
#pragma once
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

#include "base/link/replay_bus.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// What two runs have in common.
struct Comparison {
  std::int64_t compared{};     ///< messages of A that were looked for in B
  std::int64_t differences{};  ///< of these, those that differ or are not there
  /// The first of them in the order of A's log: `logged` is A's value, `recomputed` B's.
  std::optional<link::LogDifference> first;
  /// By key: A's and B's value, as in summary.json; null where a run has none.
  std::map<std::string, std::pair<std::string, std::string>> figures;
};

/// Compares the messages of the control system, sessions apart; signs of life and what terminals said are left
/// out.
[[nodiscard]] Comparison compare_runs(const RunRecord& a, const RunRecord& b);

/// Prints it. @return exit status: 1 when a message differs
int report_comparison(const Comparison& comparison, bool json, std::ostream& out);

}  // namespace mrroc::ui
