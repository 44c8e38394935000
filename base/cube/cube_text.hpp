// Reads a cube that is written as facelets or as the turns that scramble it.
#pragma once
#include <string_view>

#include "base/cube/cube.hpp"

namespace mrroc::cube {

/// @return whether a text is meant as facelets and not as turns: at least 40 characters besides blanks, of which at most
///         two are the signs behind a turn, and which are no turns one by one. A sequence of single letters is turns,
///         unless a letter follows itself
[[nodiscard]] bool means_facelets(std::string_view text);

/// @param text  facelets or turns, with blanks and ends of lines where they please
/// @throws FaultError bad_cube, naming what is wrong: of facelets their number, the letter or the rule, of turns the
///         character
[[nodiscard]] Cube read_cube(std::string_view text);

/// @param line  of a file: as above, but what stands behind facelets, after a blank, is not read
[[nodiscard]] Cube read_cube_line(std::string_view line);

}  // namespace mrroc::cube
