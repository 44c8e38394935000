// The errors that the task adds to the framework's table.
#pragma once
#include <array>

#include "base/fault.hpp"

namespace mrroc::box_push {

inline constexpr FaultCode kNoWayForBox{kFirstTaskFault};
inline constexpr FaultCode kNoWayBehindBox{kFirstTaskFault + 1};
inline constexpr FaultCode kBoxNotMoved{kFirstTaskFault + 2};
inline constexpr FaultCode kBoxNotThereYet{kFirstTaskFault + 3};

// clang-format off
/// Their rows of the table of errors.
inline constexpr std::array kFaults{
    FaultEntry{kNoWayForBox, "no_way_for_box", FaultClass::non_fatal, "no pushes lead the box to its goal", "choose a goal farther from walls and obstacles, or make room",
               "walls or obstacles too near to the box, to its goal or to the way between them: two platforms need room behind the box"},
    FaultEntry{kNoWayBehindBox, "no_way_behind_box", FaultClass::non_fatal, "a platform finds no way to its place behind the box", "make room around the box, or move the platforms away from it by hand",
               "a gap that is narrower than twice task.reach; a platform that stands too near to the box, to a wall or to the other platform"},
    FaultEntry{kBoxNotMoved, "box_not_moved", FaultClass::non_fatal, "both platforms push, and the box does not go with them", "look what holds the box; a lighter load or a smoother ground is needed for two platforms",
               "a box that is too heavy or rubs too much; something in its way; a floor on which the wheels spin"},
    FaultEntry{kBoxNotThereYet, "box_not_there_yet", FaultClass::non_fatal, "the pushes that are allowed are used up, and the box is not at its goal", "look at the numbers of the pushes in plots/path.png, and allow more with --set task.pushes=20",
               "task.pushes too few for the way; a box of another size than task.box_size; a tolerance finer than what can be seen of the box"},
};
// clang-format on
inline const RegisteredFaults kRegisteredFaults{kFaults};

}  // namespace mrroc::box_push
