// The command `ui_cli view`.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace mrroc::view {

/// Serves the page until Ctrl-C or SIGTERM. With --with-task it also ends by itself when for five seconds no task has
/// been followed and no page has been open. The first line on out is `view: http://127.0.0.1:PORT/`, with
/// --json `{"url":"http://127.0.0.1:PORT/"}`.
/// @param arguments  behind the word view
/// @return exit status: 0; 2 for bad usage or a run folder that cannot be shown
int run_view(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::view
