// `ui_cli log check`: recomputes every process of a run that can be recomputed from its log, with the same
// programs.
#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "base/link/log_check.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Starts a program and gives what it printed: the verdict as JSON.
using Prover =
    std::function<std::string(const std::string& program, const std::vector<std::string>& arguments)>;

/// @return a prover that starts the programs beside this one
/// @throws FaultError (when called) start_failed, bad_log
[[nodiscard]] Prover programs_beside();

/// Asks the program of one process of the run for its verdict.
/// @throws FaultError what the prover throws
[[nodiscard]] link::LogVerdict check_process_of(const RunRecord& run, const LoggedProcess& process,
                                                const Prover& prove);

/// Asks the program of every process of the run for its verdict.
/// @throws FaultError bad_log: the folder does not tell what ran; what the prover throws
[[nodiscard]] std::vector<link::LogVerdict> check_run(const RunRecord& run, const Prover& prove);

/// Tells the build ID of a program (base/build_id.hpp), empty: not known.
using BuildIds = std::function<std::string(const std::string& program)>;
/// @return those of the programs beside this one
[[nodiscard]] BuildIds build_ids_beside();

/// @return names of the processes whose programs have been built otherwise since the run, as far as that is known
[[nodiscard]] std::vector<std::string> changed_programs(const RunRecord& run, const BuildIds& build_ids);
/// @return a line that says so; empty without any
[[nodiscard]] std::string changed_programs_line(const std::vector<std::string>& changed);

/// Prints a line per process and what differs first.
/// @param changed  as changed_programs(): part of the JSON alone
/// @param damage  what is wrong with the log itself (log_whole.hpp), empty: nothing
/// @return exit status: 1 when something differs, or could not be checked to its end, or no process could be checked at
///         all, otherwise 0
int report_check(const std::filesystem::path& folder, const std::vector<link::LogVerdict>& verdicts,
                 const std::vector<std::string>& changed, const std::string& damage, bool json,
                 std::ostream& out);

}  // namespace mrroc::ui
