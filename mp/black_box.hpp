// The last actions of a run's processes, taken out of its log after a fault.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/event_log.hpp"

namespace mrroc::mp {

/// Simulated time before the end that is kept [s].
inline constexpr double kBlackBox = 5;

/// @param channel  without the session
/// @param message  name of its message's type; empty: not known, and the last word of the channel stands for its kind
/// @return the process that sends it, "" when no rule tells. `NAME.status` and `NAME.console` name it. Of other channels the
///         last word of the message's name tells the level, also for a message of a task: an order, an answer, a control
///         and an image come from MP, a command and a report from an ECP, a reply and samples from an EDP, a reading
///         from a VSP, a frame and a truth from the simulator
[[nodiscard]] std::string sender_of(const std::string& channel, std::string_view message);

/// Writes black_box/PROCESS.txt for every process of the roster: what it sent in the last kBlackBox seconds, a line per
/// message with simulated time, channel, stamp and every field that is not zero. Steps of drivers are in files of
/// their own, see edp::RecordFiles.
/// @param folder  of the run, with its log closed or flushed  @param roster  all processes
/// @param within  folder below black_box/ for these files; empty: that one itself. For faults after which a task goes on
/// @param as_of   the moment at which those seconds end; none: the end of the log and of its tail in the folder
/// @return every file of the folder that belongs to the black box, sorted, relative to it; a log that cannot be read
///         leaves out what it would tell
std::vector<std::string> write_black_box(const std::filesystem::path& folder,
                                         const std::vector<std::string>& roster,
                                         const std::string& within = "",
                                         const std::optional<link::LogEnd>& as_of = {});

/// @return every file of a run folder that belongs to its black boxes, sorted, relative to it
[[nodiscard]] std::vector<std::string> black_box_files(const std::filesystem::path& folder);

}  // namespace mrroc::mp
