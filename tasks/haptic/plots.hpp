// Pictures of a run: the ways of both arms, the force that is felt beside the force that is exerted, and the energies of both ports.
#pragma once
#include <vector>

#include "launch/evaluation.hpp"
#include "tasks/haptic/coupling.hpp"

namespace mrroc::haptic {

/// @return charts over time that read haptic.csv
[[nodiscard]] std::vector<launch::Picture> pictures(const Law& law);

}  // namespace mrroc::haptic
