// Passes the messages of an event log on as if they arrived: what listens to a session can listen to its record.
#pragma once
#include <filesystem>

#include "base/link/bus.hpp"

namespace mrroc::link {

/// Gives the sink every message of an event log, in the order in which they were written, with the channel's whole
/// name. A log that was cut short is passed on as far as it goes. Allocates; not for the servo step.
/// @return number of messages
/// @throws FaultError bad_log when the file is missing or holds no message
std::int64_t pass_events(const std::filesystem::path& file, Sink& sink);

}  // namespace mrroc::link
