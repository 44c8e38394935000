// The command cube_solve.
#pragma once
#include <iosfwd>

#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Input and output of the command.
struct SolveStreams {
  std::istream& in;   ///< cubes, with --file -
  std::ostream& out;  ///< a line for each cube that is solved: the number of turns, then the turns
  std::ostream&
      err;  ///< errors, and for each solution which search found it and whether it is proven to be shortest
};

/// Solves the cubes of the command line, of a file or of the standard input.
/// @param standard  the tables that --tables default stands for; tests take smaller ones
/// @return exit status: 0 all solved, 2 bad usage or a cube that is impossible
int run_cube_solve(int argc, const char* const* argv, const SolveStreams& streams,
                   TableSet standard = TableSet::standard);

}  // namespace mrroc::rubik
