// Output of one-shot commands: text for people, JSON for scripts. The JSON keys are documented at the
// functions.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/link/session.hpp"
#include "ui_cli/client.hpp"
#include "ui_cli/snapshot.hpp"

namespace mrroc::ui {

/// @param session  that hints are to name; empty: none  @return several lines, each ended
std::string status_text(const Snapshot& s, std::string_view session = {});
/// One object: session, task, state, m, behaviour, ended_because, waits_for_trigger, macrostep, sim_s [s],
/// speed, progress (0..1 or null), progress_text, agents: [{name, m, behaviour, ended_because, T_0E: [m, angle-axis
/// rad], F_a: [N, N m], sensor}], processes: [{name, state, age_s}], last_message: {code, text}, run_folder. Numbers that are
/// not finite are null, and T_0E before homing.
std::string status_json(const Snapshot& s);

/// @return a table with a line per session, or a line that says that there is none
std::string sessions_text(const std::vector<link::SessionInfo>& sessions);
/// One array of {session, task, pid, id, url (or null), run_folder}.
std::string sessions_json(const std::vector<link::SessionInfo>& sessions);

/// @return what was done, in a line
std::string answer_text(const Answer& answer);
/// One object: order, accepted, text.
std::string answer_json(const Answer& answer);

}  // namespace mrroc::ui
