// The end of a run: whether the task is done, and the content of its summary.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/motion.hpp"
#include "mp/figure_table.hpp"
#include "mp/run_folder.hpp"
#include "mp/run_log.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// Figures that any run may have.
inline constexpr std::array kRunFigures{
    FigureInfo{.key = "stop_steps_max",
               .words = "steps until the arms were at rest",
               .unit = "",
               .high = 100,
               .always = true},
    FigureInfo{.key = "late_periods", .words = "late periods of all processes", .unit = ""},
    FigureInfo{.key = "log_gaps", .words = "messages that the log missed", .unit = "", .low = 0, .high = 0},
    FigureInfo{.key = "log_left_out", .words = "messages after the end of the log", .unit = ""}};

/// @param outcome  of the task's program, which has ended
/// @return why the task is not done; nothing: every node has told that it is, with the fingerprints of what it sent
[[nodiscard]] std::optional<Fault> why_not_done(const Supervisor& supervisor, Outcome outcome);

/// A run whose processes have ended.
struct EndedRun {
  std::string task;                          ///< its name
  std::filesystem::path folder;              ///< of the run
  std::vector<std::string> roster;           ///< all processes
  Outcome outcome{};                         ///< of the task's program
  double sim_s{};                            ///< simulated time [s]
  double wall_s{};                           ///< wall time of the same [s]
  std::optional<std::int64_t> late{};        ///< periods of all processes; nothing: they do not count
  std::vector<RecoverableFault> survived{};  ///< faults after which it went on
};

/// Closes the log, and writes black box and summary.
/// @return the summary without the task's own figures; also when it could not be written, which is its fault then
[[nodiscard]] Summary summarize(const EndedRun& run, const Supervisor& supervisor, RunLog& log);

}  // namespace mrroc::mp
