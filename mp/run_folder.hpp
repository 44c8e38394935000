// The folder into which a run writes all its files.
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/fault.hpp"

namespace mrroc::mp {

/// A figure of a run: one number, or one per arm.
using Figure = std::variant<double, std::vector<double>>;

/// By their keys in summary.json.
using Figures = std::map<std::string, Figure>;

/// What is wanted of every number of a figure, in its unit.
struct FigureBounds {
  double low{-std::numeric_limits<double>::infinity()};  ///< at least; not finite: no bound
  double high{std::numeric_limits<double>::infinity()};  ///< at most; not finite: no bound
};

/// A fault after which the task went on.
struct RecoverableFault {
  Fault fault;     ///< with its process
  double sim_s{};  ///< simulated time at which it was told [s]
};

/// Content of summary.json.
struct Summary {
  std::string task;                              ///< its name
  std::optional<Fault> fault;                    ///< none: the task is done
  bool stopped{};                                ///< the operator ended it
  double sim_s{};                                ///< simulated time [s]
  double wall_s{};                               ///< wall time of the same [s]
  std::uint64_t log_hash{};                      ///< 0: unknown
  Figures figures;                               ///< of the task
  std::map<std::string, FigureBounds> wanted{};  ///< of those of which something is wanted, by key
  std::vector<RecoverableFault> survived{};      ///< in the order in which they came
  std::vector<std::string> black_box{};  ///< files of the folder that tell of the seconds before the faults
};

/// Names the folder of a run; makes nothing.
/// @param wanted  empty: runs/TASK-TIME below the working directory
/// @throws FaultError bad_usage when it exists and is not an empty folder, as nothing is overwritten, or its name is too
///         long; cannot_write when there can be no folder
std::filesystem::path name_run_folder(const std::filesystem::path& wanted, const std::string& task);

/// Makes the folder of a run.
/// @throws FaultError cannot_write
void make_run_folder(const std::filesystem::path& folder);

/// Removes the folder of a run that did not begin, with all that is in it. A folder without a configuration is left alone.
void discard_run_folder(const std::filesystem::path& folder) noexcept;

/// Writes summary.json.
void write_summary(const std::filesystem::path& folder, const Summary& summary);

/// Writes a file.
/// @throws FaultError cannot_write
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace mrroc::mp
