// `ui_cli log compare`: finds the first difference between two runs.
#pragma once
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

#include "base/link/replay_bus.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Result of the comparison of two runs.
struct Comparison {
  std::string task_a, task_b;  ///< names of the tasks
  std::int64_t compared{};     ///< messages of either run; one that both have counts once
  std::int64_t differences{};  ///< of these, those that differ or that one run lacks
  std::int64_t only_a{};       ///< of the differences, those that B lacks
  std::int64_t only_b{};       ///< those that A lacks
  /// The first of them in the order of A's log: `logged` is A's value, `recomputed` B's.
  std::optional<link::LogDifference> first{};
  /// By key: A's and B's value, as in summary.json; null where a run has none.
  std::map<std::string, std::pair<std::string, std::string>> figures{};
};

/// Compares the messages of the control system, sessions apart; signs of life and what terminals said are left
/// out.
[[nodiscard]] Comparison compare_runs(const RunRecord& a, const RunRecord& b);

/// Prints it. @return exit status: 1 when a message differs
int report_comparison(const Comparison& comparison, bool json, std::ostream& out);

}  // namespace mrroc::ui
