#include <iostream>

#include "base/link/session.hpp"
#include "base/standard_files.hpp"
#include "edp/stability_command.hpp"
#include "ui_cli/commands.hpp"
#include "ui_cli/config_command.hpp"
#include "ui_cli/doctor.hpp"
#include "ui_cli/explain.hpp"
#include "ui_cli/log/log_command.hpp"
#include "ui_cli/log/replay.hpp"
#include "ui_cli/new/new_command.hpp"
#include "ui_cli/view/view_command.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  keep_standard_files();
  const link::SessionPlace sessions = link::session_place();
  if (!sessions.note.empty()) std::cerr << sessions.note << "\n";
  const int status =
      ui::run(argc, argv,
              {std::cout,
               std::cerr,
               sessions.directory,
               link::open_session,
               {},
               {{"doctor",
                 "Look whether this host suits the framework, and what to type (no task needed)",
                 ui::run_doctor,
                 {"--json"}},
                {"explain", "Say what an error means, what it mostly comes from, what to do (no task needed)",
                 ui::run_explain, ui::explain_words()},
                {"config", "List what --set changes; --truth: what the plant really is (no task needed)",
                 ui::run_config, ui::config_words()},
                {"new", "Write the files of a new robot, platform, task or sensor (no task needed)",
                 ui::run_new, ui::new_words()},
                {"log", "Show, plot, compare and recompute runs that have been (no task needed)", ui::run_log,
                 ui::log_words()},
                {"replay",
                 "Publish a run once more, for terminals and virtual sensors (no task needed)",
                 [&sessions](const auto& arguments, std::ostream& out, std::ostream& err) {
                   return ui::run_replay(arguments, {sessions.directory, link::open_session}, out, err);
                 },
                 {"--with", "--speed", "--from", "--without", "--session", "--json"}},
                {"view",
                 "Show a running task, or a run folder, as a web page on this host",
                 view::run_view,
                 {"--port", "--session", "--url", "--key-file", "--with-task", "--json"}},
                {"stability",
                 "Tell which contact the force law bears (no task needed)",
                 edp::run_stability,
                 {"--json", "--map"}}}});
  return end_standard_output(status);
}
