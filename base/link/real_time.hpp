// Requests real-time scheduling and memory from the operating system (docs/timing.md).
#pragma once
#include <string>

namespace mrroc::link {

/// @return whether all memory of the process may be locked, also what it allocates later: the limit (RLIMIT_MEMLOCK) is
///         infinite or does not hold, as for root. Tries to lock more than it; allocates address space, no memory
[[nodiscard]] bool may_keep_in_memory();

/// Keeps the process's memory in RAM, if that is permitted: code that has not run for a while, such as that of an
/// emergency stop, is then not read from the disk first.
/// @return whether it was permitted
bool keep_in_memory();

/// Asks for the scheduler SCHED_FIFO for the calling thread and those that it will start, and keeps the process in
/// memory. What is not permitted is left as it is.
/// @param priority 1..99; the simulator above the drivers, the drivers above the rest
/// @return what was permitted and what was not, in a few words
std::string become_real_time(int priority);

/// Keeps the calling thread, and those that it will start, on one core.
/// @param core  0, 1, ... @return whether the system has that core and permits it
bool pin_to_core(int core);

/// Leaves SCHED_FIFO, if the calling thread has it, and becomes nicer: for work that may take as long as it does, such as
/// that on pictures, in a process in which others must be in time.
/// @param nice  1..19; 0 is what other threads have
void become_background(int nice);

}  // namespace mrroc::link
