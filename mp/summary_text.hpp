// The text that a task prints when it has ended.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "mp/figure_table.hpp"
#include "mp/options.hpp"
#include "mp/run_folder.hpp"

namespace mrroc::mp {

/// Data of a finished run that are printed besides its summary.
struct Ending {
  std::filesystem::path folder;                   ///< of the run
  std::string figures{};                          ///< lines, see figure_table()
  std::vector<std::filesystem::path> pictures{};  ///< of the run
  FigureVerdict verdict{};                        ///< on the figures of a run that came to its end
  std::string only{};  ///< says that little is wanted of the run, and what; it stands before the verdict
};

/// @return how the run ended and how long it took, then figures and pictures,
///         and what there is to see in the viewer that was asked for
[[nodiscard]] std::string ending_text(const Summary& summary, const Ending& ending,
                                      const TaskOptions& options);

/// Prints that, the error line on standard error, if there is one, a line with the verdict on the figures of a run that is
/// done, and the run folder as the last line.
/// @return exit status of the task; with --strict 1 when a figure misses what is wanted
[[nodiscard]] int print_ending(const Summary& summary, const Ending& ending, const TaskOptions& options);

}  // namespace mrroc::mp
