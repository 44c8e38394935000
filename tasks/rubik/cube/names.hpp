// Makes the names of base/cube available in this task without their namespace.
#pragma once

namespace mrroc::cube {}
namespace mrroc::rubik {
using namespace cube;
}
