// The platform Rex of the paper REX: four wheels that skid, each with a drive of its own.
#pragma once
#include "edp/platform/platform.hpp"

namespace mrroc::rex {

/// @return Rex, whose trackers are "nmpc" and "kinematic"; lives to the end of the program
[[nodiscard]] const edp::Platform& platform();

}  // namespace mrroc::rex
