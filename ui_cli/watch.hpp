// The full-screen view.
#pragma once
#include <string>

#include "base/link/bus.hpp"
#include "ui_cli/client.hpp"

namespace mrroc::ui {

/// Shows the task ten times a second until the operator leaves. The task goes on.
/// @param session  that hints have to name; empty: none
/// @throws FaultError bad_usage when standard input or output is no terminal
void watch(link::Bus& bus, Client& client, const std::string& session);

}  // namespace mrroc::ui
