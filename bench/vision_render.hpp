// Time that a picture of the simulated cell takes.
#pragma once
#include "bench/figures.hpp"

namespace mrroc::bench {

/// @return render_ms (profile exact) and render_fast_ms, of a distorted and noisy picture of 640x480 pixels
/// @throws FaultError no_renderer
Figures run_render_figures();

}  // namespace mrroc::bench
