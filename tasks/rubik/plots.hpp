// Pictures of a run: MG fig. 16 and 17, and the times of all turns.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tasks/rubik/rubik_run.hpp"

namespace mrroc::rubik {

/// A marked point of a figure.
struct Mark {
  char letter{};  ///< as in the paper's figure
  double t{};     ///< [s]
  double y{};     ///< [N] or [N m]
};

/// Points of fig. 16, from the worker's rows of one cycle: A impact, B settled.
[[nodiscard]] std::vector<Mark> marks_of_approach(const mp::ArmTrace& worker);
/// Points of fig. 17, from the rows of the arm that turns: A the grasp begins, B the jaws hold, C the turn begins, D the
/// face breaks away, E and F the friction's largest and least value behind it, G the end of the turn, H of the opening.
/// Those that there are.
/// @param quarters  that the face is turned by, 1 or 2: at a seat on the way it breaks away again, so D to F are of the
///                  first quarter
[[nodiscard]] std::vector<Mark> marks_of_turn(const mp::ArmTrace& turning, int quarters = 1);

/// @return name and gnuplot script of each picture; the scripts read the tables of the run folder. Fig. 16 and 17 are of
///         the first turn that was done, of a quarter if there is one
[[nodiscard]] std::vector<std::pair<std::string, std::string>> plots(const RunRecord& record);

}  // namespace mrroc::rubik
