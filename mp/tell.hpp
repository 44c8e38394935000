// What a running task tells the person in front of its terminal.
#pragma once
#include <string>
#include <string_view>

namespace mrroc::mp {

/// @param line   a line of progress; one that begins with its time, "    0.50 s  ", goes on below what is behind that
/// @param width  characters of a line; 0: any
/// @return the line, broken between words where it is longer
[[nodiscard]] std::string folded(std::string_view line, int width);

/// Prints a line to standard output at once, broken at the terminal's width if that is a terminal.
/// @param line     with commands as as_typed() wants them
/// @param session  that hints have to name; empty: none
void tell(std::string_view line, std::string_view session = {});

}  // namespace mrroc::mp
