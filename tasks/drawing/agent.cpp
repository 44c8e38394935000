// The transparent agents a_1 and a_2 (MS 34-36).
#include "ecp/transparent.hpp"
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {

const Motion<Arm> kTransparent = ecp::transparent<Arm>();

}  // namespace mrroc::drawing
