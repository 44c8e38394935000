// Computations of the figures of the group operator, one function for each method.
#pragma once
#include "bench/figures.hpp"

namespace mrroc::bench {

/// The viewer beside a task without robots: viewer_cpu_pct, viewer_lost. Half a minute.
/// @throws FaultError start_failed
Figures viewer_figures();
/// Keys pressed in the full-screen terminal while press runs in real time. Ten minutes.
/// @throws FaultError start_failed, no_such_session, peer_silent
Figures latency_figures();
/// Short runs of all tasks, recomputed from their logs: log_check_differences. Two minutes.
/// @throws FaultError start_failed: a task did not end well; bad_log: a run could not be checked
Figures log_check_figures();
/// A new clone until its arm moves: fresh_clone_s. Then the builds there after a changed line in a task, rebuild_s, and
/// in the effector driver, driver_rebuild_s. As long as a first build, some ten minutes.
/// @throws FaultError cannot_write, start_failed
Figures clone_figures();
/// Runs the test of the documents' commands; what share of them ended well: doc_commands_run, doc_commands_as_they_stand.
/// Five minutes.
/// @throws FaultError start_failed: the test has told nothing
Figures document_figures();

}  // namespace mrroc::bench
