// Default settings of the cell: the start and the limits of its arms, and the place of its camera.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"

namespace mrroc::rubik {

/// @param sees  there is a camera, to which faces are shown
/// @return KEY=VALUE of the cell as it usually is: camera and places of showing, start joints, limits of free motions
[[nodiscard]] std::vector<std::string> cell_settings(bool sees);

/// Refuses homing. It moves one axis after the other to its switch, however the others stand: in this cell the hand with
/// the cube would meet what stands around it.
/// @throws FaultError bad_configuration
void check_synchro(const Config& config);

}  // namespace mrroc::rubik
