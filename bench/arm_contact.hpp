// The whole arm on its table: predicted against simulated limits of the gain B.
#pragma once
#include <vector>

#include "bench/figures.hpp"
#include "sim/world.hpp"

namespace mrroc::bench {

/// Random contacts of the arm on its pedestal: places of its sheet, I of law (28), stiffness of pen and paper. Neither
/// motors nor pen have friction, which is not linear.
/// @param elastic  gears have their lowest mode at 8 to 15 Hz; otherwise they are rigid
/// @return how far the predicted largest gain B is from that of the real driver in the world [%], one a contact
[[nodiscard]] std::vector<double> arm_limit_errors(sim::PhysicsEngine engine, bool elastic);

/// The worst of each engine of this build with rigid gears, and of Bullet with elastic ones.
[[nodiscard]] Figures arm_limit_figures();

}  // namespace mrroc::bench
