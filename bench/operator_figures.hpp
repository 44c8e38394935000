// What the figures of the group operator are made of, one function for each method.
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
/// The build after a changed line in a task: rebuild_s; nothing on a host where it cannot be measured.
/// @throws FaultError start_failed
Figures rebuild_figures();
/// What share of the documents' commands the tests run: doc_commands_run. At once.
Figures document_figures();

}  // namespace mrroc::bench
