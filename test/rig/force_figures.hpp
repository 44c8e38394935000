// Identification of tools and the force without contact, on the simulated arm with its real driver.
#pragma once
#include <cstdint>

namespace mrroc::rig {

/// The results.
struct ForceFigures {
  double weight_pct{};      ///< largest error of the identified weight [%]
  double centre_mm{};       ///< largest error of the identified mass centre [mm]
  double free_force_N{};    ///< mean over the orientations of |mean F_a| without contact [N]
  double free_torque_Nm{};  ///< the same of the moments about the tip [N m]
};

/// @param tools         random ones of 3 to 20 N, centres up to 3 cm off the axis and 5 to 20 cm from the
/// wrist
/// @param orientations  random ones of the first tool, after it was identified
ForceFigures measure_forces(int tools, int orientations, std::uint64_t seed);

}  // namespace mrroc::rig
