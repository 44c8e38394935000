// The command `ui_cli manual`: instructions to the arms of the task `manual`, and what the arms are doing.
#pragma once
#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "base/link/bus.hpp"
#include "base/link/session.hpp"
#include "ui_cli/client.hpp"

namespace mrroc::ui {

/// What the words behind `ui_cli manual` say.
struct ManualWish {
  std::string words;  ///< the instruction; "show ARM" is answered here
  std::string show;   ///< arm whose state is wanted; empty: an instruction
  bool wait{true};    ///< until it is done; false: until it is taken
  bool json{};
  std::string session, url;
};

/// @param arguments  words and options in any order: numbers may be negative
/// @throws FaultError bad_usage
[[nodiscard]] ManualWish read_manual_words(const std::vector<std::string>& arguments);

/// Words behind `ui_cli manual`, for the shell's completion.
[[nodiscard]] std::vector<std::string> manual_words();

/// Sends an instruction until it is answered, or prints the state of an arm.
/// @throws FaultError illegal_in_state: refused or failed, with the reason; peer_silent: nobody answers
void execute_manual(link::Bus& bus, const link::SessionInfo& session, const ManualWish& wish,
                    const Patience& patience, std::ostream& out);

extern const char* const kManualHelp;

}  // namespace mrroc::ui
