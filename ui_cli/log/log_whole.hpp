// Checks that a log has every message that the processes of its run report as sent.
#pragma once
#include <iosfwd>
#include <string>

#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Compares the messages of every channel, by number and fingerprint, with what its sender told when it ended.
/// Channels that were never logged (the servo links) are left out, and processes that did not end well.
/// @return what is wrong first, for people; empty: nothing
[[nodiscard]] std::string damage_of(const RunRecord& run);

/// Writes a line on `err` when the log of a run whose processes are known is not whole: what is shown of it may lack
/// something.
void warn_of_damage(const RunRecord& run, std::ostream& err);

}  // namespace mrroc::ui
