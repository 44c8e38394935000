#include "ecp/effector_links.hpp"

#include "ecp/effector_links_impl.hpp"

namespace mrroc::ecp {

template class EffectorLinks<ArmEffector>;
template class EffectorLinks<PlatformEffector>;

}  // namespace mrroc::ecp
