// Starts the viewer beside a task.
#pragma once
#include <string>

namespace mrroc::mp {

/// Starts `ui_cli view` for a session, as a process of its own: it is no part of the task, which neither waits for it nor
/// ends it. It ends by itself when the task has ended and nobody looks any more. Waits for its address, at most 3 s.
/// @return a line for the operator: `view: http://127.0.0.1:PORT/`, or why there is no viewer
[[nodiscard]] std::string start_viewer(const std::string& session);

}  // namespace mrroc::mp
