#include "edp/protocol.hpp"

#include "edp/protocol_impl.hpp"

namespace mrroc::edp {

template class BasicProtocol<ArmEffector>;
template class BasicProtocol<PlatformEffector>;

}  // namespace mrroc::edp
