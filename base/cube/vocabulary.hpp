// The cube's entries in the framework's table of errors.
#pragma once
#include <array>

#include "base/fault.hpp"

namespace mrroc::cube {

inline constexpr FaultCode kBadCube{67};

// clang-format off
/// Its row of the table of errors.
inline constexpr std::array kCubeFaults{
    FaultEntry{kBadCube, "bad_cube", FaultClass::non_fatal, "the cube cannot be solved, or its description cannot be read", "look at the stickers named, or at the turns",
               "stickers copied wrongly; a corner or an edge that was put in turned; faces in another order than U R F D L B"},
};
// clang-format on
inline const RegisteredFaults kRegisteredCubeFaults{kCubeFaults};

}  // namespace mrroc::cube
