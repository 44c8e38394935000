// The goal of a plan: turns of faces, or faces to be shown.
#pragma once
#include <span>
#include <vector>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Turns of one face, or of two opposite ones, whose order does not matter.
struct TurnGroup {
  std::vector<Move> moves;  ///< one or two
};
/// @return the turns so grouped; those of one face are taken together, and what cancels is left out
[[nodiscard]] std::vector<TurnGroup> grouped(std::span<const Move> moves);

/// Turns, or faces to be shown.
struct PlanGoal {
  std::vector<TurnGroup> groups;  ///< in the order of execution; not with show_all
  bool show_all{};                ///< each of the six faces, to the camera
};

}  // namespace mrroc::rubik
