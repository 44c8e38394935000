#include "edp/simulated_hardware.hpp"

#include "edp/simulated_hardware_impl.hpp"

namespace mrroc::edp {

template class BasicSimulatedHardware<ArmEffector>;
template class BasicSimulatedHardware<PlatformEffector>;

}  // namespace mrroc::edp
