// The command `ui_cli manual`: sends instructions to the arms of the task `manual`, and shows their states.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "base/effector_command.hpp"
#include "base/link/bus.hpp"
#include "base/link/session.hpp"
#include "ui_cli/client.hpp"

namespace mrroc::ui {

/// Meaning of the words behind `ui_cli manual`.
struct ManualRequest {
  std::string words;            ///< the instruction; "show", "save", "teach" and "load" are answered here
  std::string show;             ///< arm whose state is wanted; empty: an instruction
  std::filesystem::path save;   ///< where the position of that arm is written down; empty: it is shown
  std::filesystem::path teach;  ///< motions to which that arm's position is added; empty: none
  Representation space{Representation::joints};  ///< of the position that is taught
  std::filesystem::path load;  ///< instructions that are given one after the other, a line each; empty: none
  bool wait{true};             ///< until it is done; false: until it is taken
  bool json{};                 ///< answers as JSON instead of words for people
  std::string session, url;    ///< --session and --url; may be empty
  std::filesystem::path key_file;  ///< --key-file; may be empty
};

/// @param arguments  words and options in any order: numbers may be negative
/// @throws FaultError bad_usage
[[nodiscard]] ManualRequest read_manual_words(const std::vector<std::string>& arguments);

/// Words behind `ui_cli manual`, for the shell's completion.
[[nodiscard]] std::vector<std::string> manual_words();

/// Sends an instruction until it is answered, or those of a file, each when the one before is done; or prints the
/// state of an arm, or adds its position to a file as the instruction that leads there: `move ARM joints NUMBER...`, or to the motions of one for the task `move`.
/// @throws FaultError illegal_in_state: refused; failed: as the driver says, with the reason, or a position is not
///                    known; peer_silent: nobody answers; bad_script, cannot_write: the file
void execute_manual(link::Bus& bus, const link::SessionInfo& session, const ManualRequest& request,
                    const Timeouts& timeouts, std::ostream& out);

/// @return what the words are: for `ui_cli manual --help`
[[nodiscard]] std::string manual_help();

}  // namespace mrroc::ui
