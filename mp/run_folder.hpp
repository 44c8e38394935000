// The folder in which a run leaves everything that it knows.
#pragma once
#include <cstdint>
#include <filesystem>
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

/// A fault after which the task went on.
struct SurvivedFault {
  Fault fault;     ///< with its process
  double sim_s{};  ///< simulated time at which it was told [s]
};

/// What summary.json says.
struct Summary {
  std::string task;                       ///< its name
  std::optional<Fault> fault;             ///< none: the task is done
  bool stopped{};                         ///< the operator ended it
  double sim_s{};                         ///< simulated time [s]
  double wall_s{};                        ///< wall time of the same [s]
  std::uint64_t log_hash{};               ///< 0: unknown
  Figures figures;                        ///< of the task
  std::vector<SurvivedFault> survived{};  ///< in the order in which they came
  std::vector<std::string> black_box{};   ///< files of the folder that tell of the seconds before the faults
};

/// Names the folder of a run; makes nothing.
/// @param wanted  empty: runs/TASK-TIME below the working directory
/// @throws FaultError bad_usage when it exists and is not an empty folder: nothing is overwritten
std::filesystem::path name_run_folder(const std::filesystem::path& wanted, const std::string& task);

/// Makes the folder of a run.
/// @throws FaultError cannot_write
void make_run_folder(const std::filesystem::path& folder);

/// Writes summary.json.
void write_summary(const std::filesystem::path& folder, const Summary& summary);

/// Writes a file.
/// @throws FaultError cannot_write
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace mrroc::mp
