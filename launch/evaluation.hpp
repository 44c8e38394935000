// Figures and pictures over time that evaluate a run from the rows of its arms.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/time_chart.hpp"
#include "launch/results.hpp"
#include "mp/arm_trace.hpp"
#include "mp/solo_run.hpp"

namespace mrroc::launch {

/// One picture of a run: a script, or a chart over time.
struct Picture {
  std::string name;  ///< file in plots/ without .png
  std::string
      script{};  ///< gnuplot, run in the run folder, that writes plots/NAME.png; empty: the chart does
  std::optional<TimeChart> chart{};  ///< its output is set when it is drawn, and its time where that is empty
  std::vector<std::size_t> arms{};   ///< whose behaviours the chart's panels show; indices of the task's arms
};

/// Functions may be empty. They get an empty trace of an arm that has done nothing.
struct Evaluation {
  std::vector<mp::BehaviourWords> behaviours{};  ///< m = 1, 2, ... of the traces
  /// Figures for summary.json and the table at the end, from the rows of all arms.
  std::function<mp::TaskFigures(const std::vector<mp::ArmTrace>&, const Config&)> figures{};
  /// Pictures, which read arm1.csv and so on.
  std::function<std::vector<Picture>(const std::vector<mp::ArmTrace>&, const Config&)> pictures{};
  /// Purpose of the run, in words, for the end of the output.
  std::function<std::string(const std::vector<mp::ArmTrace>&)> result{};
};

/// Makes the results of a run, for Task::results. The traces are those of its coordinator, with the forces of every step.
void evaluate(const Evaluation& evaluation, Results& results);

/// @return what the rows of a table say about themselves, in their order
template <class Rows>
std::vector<mp::BehaviourWords> words_of(const Rows& rows) {
  std::vector<mp::BehaviourWords> words;
  for (const auto& row : rows) words.push_back({std::string(row.name), std::string(row.until)});
  return words;
}

}  // namespace mrroc::launch
