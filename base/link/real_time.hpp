// What a process asks of the operating system when time counts (docs/timing.md).
#pragma once
#include <string>

namespace mrroc::link {

/// @return whether all memory of the process may be locked, also what it allocates later: by a limit that is infinite, or by
///         the capability CAP_IPC_LOCK, which root has
[[nodiscard]] bool may_keep_in_memory();

/// Keeps the process's memory in RAM, if that is permitted: code that has not run for a while, such as that of an
/// emergency stop, is then not read from the disk first.
/// @return whether it was permitted
bool keep_in_memory();

/// Asks for the scheduler SCHED_FIFO for the calling thread and those that it will start, and keeps the process in
/// memory. What is not permitted is left as it is.
/// @param priority 1..99; the world above the drivers, the drivers above the rest
/// @return what was permitted, in a few words; empty when nothing was
std::string become_real_time(int priority);

}  // namespace mrroc::link
