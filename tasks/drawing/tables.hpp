// Tables 1-4 of MS: rows of the effectors' commands, and the coordinator's behaviours m = 1..7.
#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "base/axis_command.hpp"
#include "base/motion.hpp"
#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

// clang-format off
/// tab. 1: blocked
inline constexpr TaskFrameCommand kBlocked{.x = u(), .y = u(), .z = u(), .ax = u(), .ay = u(), .az = u()};
/// tab. 2: compliant in the linear directions
inline constexpr TaskFrameCommand kCompliant{.x = c(0, 20, 0.005), .y = c(0, 20, 0.005), .z = c(0, 20, 0.005),
                                             .ax = u(), .ay = u(), .az = u()};
/// tab. 3(a): lowering; the force settles at v/B = 2 N
inline constexpr TaskFrameCommand kLowering{.x = u(), .y = u(), .z = g(0.01, 20, 0.005), .ax = u(), .ay = u(), .az = u()};
/// tab. 3(b): lift-off
inline constexpr TaskFrameCommand kLiftOff{.x = u(), .y = u(), .z = u(-0.01), .ax = u(), .ay = u(), .az = u()};
/// tab. 4(a): on the paper; velocities along x and y come from the recording
inline constexpr TaskFrameCommand kOnPaper{.x = u(), .y = u(), .z = c(1, 20, 0.005), .ax = u(), .ay = u(), .az = u()};
/// tab. 4(b): above the paper; velocities along x and y come from the recording
inline constexpr TaskFrameCommand kAbovePaper{.x = u(), .y = u(), .z = u(), .ax = u(), .ay = u(), .az = u()};
// clang-format on

/// The coordinator's behaviours m = 1..7, index m - 1.
extern const std::array<Motion<Coordinator>, 7> kCoordinator;

/// m = 0: the arms stand still until both agents are ready and the operator has given start.
extern const Motion<Coordinator> kWaitForStart;

/// The agents' only behaviour, which has no number in the paper: copying, until the task is over (MS 34-36).
extern const Motion<Arm> kTransparent;

/// @return whether m = 4 has ended because the pens were not both on the paper in time
bool no_contact(const Coordinator::X& x);

/// A sensor that drifts tells of a force that is none: its arm draws in the air, or pushes the sheet down.
/// @return the arm whose pen is farther from the level at which it first met its sheet than any sheet lies, in m = 5
std::optional<std::size_t> arm_off_its_sheet(const Coordinator::X& x);

}  // namespace mrroc::drawing
