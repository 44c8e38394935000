// The errors that the task adds to the framework's table.
#pragma once
#include <array>

#include "base/fault.hpp"

namespace mrroc::calibrate_cell {

inline constexpr FaultCode kNothingTouched{kFirstTaskFault + 8};
inline constexpr FaultCode kTouchesDoNotFit{kFirstTaskFault + 9};
inline constexpr FaultCode kBoardNotSeen{kFirstTaskFault + 10};

// clang-format off
/// Their rows of the table of errors.
inline constexpr std::array kFaults{
    FaultEntry{kNothingTouched, "nothing_touched", FaultClass::non_fatal, "an arm came to where a ball is believed and touched nothing", "measure where the balls and the base of that arm stand, set artefact.place or cell.robots.ARM.place, or make task.beyond larger",
               "balls that stand elsewhere than told; a base that is believed far from where it is; a tip that is missing"},
    FaultEntry{kTouchesDoNotFit, "touches_do_not_fit", FaultClass::non_fatal, "what the arms touched does not give the place of their bases", "use three balls or more that do not stand on a line, and hold them still",
               "too few balls, or balls on a line; balls that moved meanwhile; a kinematic model that is not that of the arm"},
    FaultEntry{kBoardNotSeen, "board_not_seen", FaultClass::non_fatal, "too few pictures show the chessboard to tell where the camera is", "look at the pictures of the receptor in the run folder, and set object.pose, cameras.CAMERA.pose or the light; or go without pictures: task.ways = \"touch\"",
               "a board or a camera that is far from where it is believed, covered, or in the dark; another board than chessboard.columns, .rows tell"},
};
// clang-format on
inline const RegisteredFaults kRegisteredFaults{kFaults};

}  // namespace mrroc::calibrate_cell
