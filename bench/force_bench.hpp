// Figures of force measurement and of the tasks press and edge_follow.
#pragma once
#include "bench/figures.hpp"

namespace mrroc::bench {

/// @throws FaultError  a task did not end well
Figures run_force_figures();

}  // namespace mrroc::bench
