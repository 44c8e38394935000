// The transparent agents a_1 and a_2 (MS 34-36).
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

using X = Arm::X;

None nothing(const X&) { return {}; }

Report copy_images(const X& x) { return ecp::report_of(x, x.T.m); }  // (34), (35)

bool finished(const X& x) { return x.T.finished; }

}  // namespace

const Motion<Arm> kTransparent{
    0,       "copy the coordinator's orders", nothing, nothing, ecp::copied_order<X>, nothing, copy_images,
    finished};

}  // namespace mrroc::drawing
