// What a process asks of the operating system for the wall clock (docs/timing.md).
#pragma once
#include <string>

namespace mrroc::link {

/// Asks for the scheduler SCHED_FIFO for the calling thread and those that it will start, and, when the limit on locked memory allows all of
/// it, for the process's memory to stay in RAM. What is not permitted is left as it is.
/// @param priority 1..99; the world above the drivers, the drivers above the rest
/// @return what was permitted, in a few words; empty when nothing was
std::string become_real_time(int priority);

}  // namespace mrroc::link
