// Finds short solutions quickly: Kociemba's two-phase algorithm, improving until its limits end it.
#pragma once
#include <cstdint>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/limits.hpp"

namespace mrroc::rubik {

/// A solution and what it took.
struct TwoPhaseResult {
  Moves moves;            ///< solves the cube
  std::uint64_t nodes{};  ///< expanded in the first phase
};

/// Searches the cube along its three axes, and its inverse along them. Begins of n turns that lead into the second
/// phase's group are tried for n = 0, 1, 2 ...; a begin is given up as soon as a lower bound tells that the whole
/// cannot become shorter than the best solution so far.
/// @param cube  reachable
/// @param limits  the search goes on until one of them is reached and there is a solution; the first one comes
///        within about a millisecond
/// @param good_enough  a solution of at most so many turns ends the search
[[nodiscard]] TwoPhaseResult solve_two_phase(const Bounds& bounds, const Cube& cube,
                                             const SearchLimits& limits, int good_enough = 0);

}  // namespace mrroc::rubik
