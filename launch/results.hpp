// Results of a run: tables, figures and pictures, and their report to the operator.
#pragma once
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "launch/cell_nodes.hpp"
#include "launch/setup.hpp"
#include "mp/coordinator_run.hpp"
#include "mp/figure_table.hpp"
#include "mp/run_folder.hpp"
#include "mp/summary_text.hpp"

namespace mrroc::launch {

/// Data of a finished run, and the results that the task makes of it.
struct Results {
  const Setup& setup;                  ///< of the run
  const std::vector<CellArm>& arms;    ///< of the run
  const std::filesystem::path folder;  ///< of the run
  mp::CoordinatorRun& coordinator;     ///< as Task::coordinator made it; it has been executed
  mp::Summary& summary;  ///< of the run that has ended, whether it came to its end; gets the task's figures
  std::vector<mp::FigureInfo> known{};      ///< gets what the figures mean, in the order of the table
  std::vector<std::string_view> columns{};  ///< gets the headings of figures with several numbers
  std::string remarks{};                    ///< gets lines that stand below the table of figures
  std::string only{};                       ///< gets what alone is wanted, where that is little: Ending::only
  /// Gets the pictures: names and gnuplot scripts, see mp::draw().
  std::vector<std::pair<std::string, std::string>> pictures{};

  /// @return the coordinator as what the task has made @throws std::bad_cast  it is another one
  template <class Run>
  [[nodiscard]] const Run& coordinator_as() const {
    return dynamic_cast<const Run&>(coordinator);
  }
  /// Adds figures to the summary. @param infos  what these and others mean, in the order of the table
  template <std::ranges::input_range Infos>
  void add(const mp::Figures& figures, const Infos& infos) {
    summary.figures.insert(figures.begin(), figures.end());
    std::ranges::copy(infos, std::back_inserter(known));
  }
};

/// Makes tables, figures and pictures. What can be done is done also when a part of it fails; then the summary has the
/// fault.
/// @param of_task  adds those of the task, after the arms' tables; may be empty
void make_results(Results& results, const std::function<void(Results&)>& of_task);

/// @return what is told at the end of the run
[[nodiscard]] mp::Ending ending_of(const Results& results);

}  // namespace mrroc::launch
