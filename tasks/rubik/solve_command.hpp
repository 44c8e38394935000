// The command cube_solve.
#pragma once
#include <iosfwd>

#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Solves the cubes of the command line or of a file. Each gives one line on out: the number of turns, then the turns.
/// @param err  what is not a solution: errors, cubes whose solution is not proven to be a shortest one
/// @param standard  the tables that --tables default stands for; tests take smaller ones
/// @return exit status: 0 all solved, 2 bad usage or a cube that is impossible
int run_cube_solve(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                   TableSet standard = TableSet::standard);

}  // namespace mrroc::rubik
