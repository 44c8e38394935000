// The sheets of the cell, for the pictures of a run.
#pragma once
#include <array>

#include "base/config.hpp"
#include "base/spatial.hpp"
#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

/// @param config  of a run
/// @return the middle of each arm's sheet, in the arm's base [m], as the simulator has been given it
/// @throws ConfigError
[[nodiscard]] std::array<Vector3, kArms> paper_places(const Config& config);

}  // namespace mrroc::drawing
