// Pictures of a run: the ways of both arms, the force that is felt beside the force that is exerted, and the energies of both ports.
#pragma once
#include "base/time_chart.hpp"
#include "tasks/haptic/coupling.hpp"

namespace mrroc::haptic {

/// Charts over time that read haptic.csv: the ways along x, y and z ...
[[nodiscard]] TimeChart motion_chart(const Law& law);
/// ... the forces along x and z ...
[[nodiscard]] TimeChart force_chart(const Law& law);
/// ... and energies of the ports, what the controllers have kept back, and the age of what the slave knows.
[[nodiscard]] TimeChart energy_chart();

}  // namespace mrroc::haptic
