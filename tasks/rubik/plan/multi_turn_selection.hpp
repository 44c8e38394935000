// Selects the turn of the last joints for each step of a sequence.
#pragma once
#include <optional>
#include <vector>

#include "tasks/rubik/plan/search.hpp"

namespace mrroc::rubik {

/// A step in postures.
struct SelectedStep {
  StepConfigurations configurations;  ///< numbers of postures, no classes
  int quarters{};                     ///< by which the track arm turns
  std::vector<ArmTransfer> motions;   ///< in their order
};

/// Chooses for each class of postures the member with which all motions together take the least time (Viterbi's
/// algorithm over the steps). @param start  postures of both hands
/// @return one for each edge; nothing: motions that are known to be blocked are in every way
[[nodiscard]] std::optional<std::vector<SelectedStep>> select_turns(const Motions& motions,
                                                                    const Node& start_classes,
                                                                    const std::array<int, 2>& start,
                                                                    const std::vector<Edge>& edges);

}  // namespace mrroc::rubik
