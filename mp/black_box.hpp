// What the processes of a run did last: taken out of its log after a fault.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace mrroc::mp {

/// Simulated time before the end that is kept [s].
inline constexpr double kBlackBox = 5;

/// @param channel  without the session  @return the process that sends on it, "" when no rule tells: `NAME.status`
/// and `NAME.console` name it, the others are those of docs/architecture.md
[[nodiscard]] std::string sender_of(const std::string& channel);

/// Writes black_box/PROCESS.txt for every process of the roster: what it sent in the last kBlackBox seconds, a line per
/// message with simulated time, channel, stamp and every field that is not zero. Steps of drivers are in files of
/// their own, see edp::RecordFiles.
/// @param folder  of the run, with its log closed or flushed  @param roster  all processes
/// @param within  folder below black_box/ for these files; empty: that one itself. For faults after which a task goes on
/// @return every file of the folder that belongs to the black box, sorted, relative to it; a log that cannot be read
///         leaves out what it would tell
std::vector<std::string> write_black_box(const std::filesystem::path& folder,
                                         const std::vector<std::string>& roster,
                                         const std::string& within = "");

/// @return every file of a run folder that belongs to its black boxes, sorted, relative to it
[[nodiscard]] std::vector<std::string> black_box_files(const std::filesystem::path& folder);

}  // namespace mrroc::mp
