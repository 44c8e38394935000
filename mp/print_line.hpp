// Prints the lines of a running task on its terminal.
#pragma once
#include <string>
#include <string_view>

#include "base/link/process.hpp"

namespace mrroc::mp {

/// @param line   a line of progress; one that begins with its time, "    0.50 s  ", goes on below what is behind that
/// @param width  characters of a line; 0: any
/// @return the line, broken between words where it is longer
[[nodiscard]] std::string folded(std::string_view line, int width);

/// Prints a line to standard output at once, broken at the terminal's width if that is a terminal.
/// @param line     with commands as command_hint() wants them
/// @param session  that hints have to name; empty: none
void print_line(std::string_view line, std::string_view session = {});

/// Reports progress: as messages of the run, and on its terminal.
class Announcer {
 public:
  /// @param process  whose messages the lines are; must outlive this object
  /// @param session  that hints have to name; empty: none
  /// @param shown    whether there is a terminal: a check of a log has none
  Announcer(link::Process& process, std::string session, bool shown);

  /// @param sim_s  simulated time [s]: stands before the line on the terminal; the message has its macrostep
  /// @param text   with commands as command_hint() wants them; what is longer than a message becomes several
  void operator()(double sim_s, const std::string& text) const;

 private:
  link::Process& process_;
  std::string session_;
  bool shown_;
};

}  // namespace mrroc::mp
