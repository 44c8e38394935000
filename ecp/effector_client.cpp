#include "ecp/effector_client.hpp"

#include "ecp/effector_client_impl.hpp"

namespace mrroc::ecp {

template class BasicEffectorClient<ArmEffector>;
template class BasicEffectorClient<PlatformEffector>;

}  // namespace mrroc::ecp
