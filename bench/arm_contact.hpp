// The whole arm on its table: predicted against simulated limits of the gain B.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "edp/stability.hpp"
#include "sim/world.hpp"

namespace mrroc::bench {

/// One contact of the arm on its pedestal: where its sheet lies and how stiff it is, and I of law (28).
struct ArmContact {
  /// Neither motors nor pen have friction, which is not linear; integrated in steps of 0.25 ms.
  sim::WorldParameters world;
  double inertia{};  ///< I of law (28) [kg]
};

/// Whether gears give way.
enum class Gears : std::uint8_t { rigid, elastic };

/// The largest stable gain B of one contact [s/kg].
struct ArmLimit {
  double stiffness{};  ///< of pen and paper [N/m]
  double inertia{};    ///< I of law (28) [kg]
  double gears{};      ///< their lowest mode [Hz], 0: rigid
  double predicted{};  ///< by edp::WholeArm
  double simulated{};  ///< of the real driver in the world; infinite: none up to twice the predicted one
};

/// @return the loop as a controller may believe it, B its default: kernel and drives of the robot, masses of its description
/// @throw FaultError out_of_limits  the arm is singular there
[[nodiscard]] edp::ContactLoop believed_loop(const ArmContact& contact);

/// Random contacts, the same for each engine: places and slopes of the sheet, 1e3 to 1e5 N/m, I of 2 to 40 kg.
/// @param gears  elastic ones have their lowest mode at 8 to 15 Hz
/// @param name   in the lines of progress @param contacts  how many, > 0
[[nodiscard]] std::vector<ArmLimit> arm_limits(sim::PhysicsEngine engine, Gears gears, const char* name,
                                               std::size_t contacts);

}  // namespace mrroc::bench
