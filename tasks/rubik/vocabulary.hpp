// The errors that the cube's task adds to the framework's table.
#pragma once
#include <array>

#include "base/fault.hpp"

namespace mrroc::rubik {

inline constexpr FaultCode kNoPlan{34};
inline constexpr FaultCode kGraspMissed{35};
inline constexpr FaultCode kFaceJammed{36};
inline constexpr FaultCode kCubeSlipped{37};
inline constexpr FaultCode kCubeDropped{38};
inline constexpr FaultCode kCubeMisread{39};

// clang-format off
/// Their rows of the table of errors.
inline constexpr std::array kFaults{
    FaultEntry{kNoPlan, "no_plan", FaultClass::non_fatal, "there is no way of the arms to do that", "look at where the arms stand and how the cube is held at the beginning",
               "a cube that is held so that the other arm cannot reach it; arms placed too far from each other"},
    FaultEntry{kGraspMissed, "grasp_missed", FaultClass::non_fatal, "a hand did not grip the cube, or did not let go of it", "look at where the cube is and how far the jaws go",
               "the cube is not where it should be; a cube of another size; a gripper that is blocked"},
    FaultEntry{kFaceJammed, "face_jammed", FaultClass::non_fatal, "a face of the cube does not turn", "take the cube out and turn the face by hand, or allow more torque with --set task.most_torque=9.5",
               "a cube that jams; layers that are not in their seats; a hand that holds the wrong layers"},
    FaultEntry{kCubeSlipped, "cube_slipped", FaultClass::non_fatal, "the cube is not where the hand that holds it should have it", "put the cube into the hand anew",
               "a grip that slipped; somebody or something touched the cube; a cube of another size"},
    FaultEntry{kCubeDropped, "cube_dropped", FaultClass::non_fatal, "the hand that held the cube is empty", "put the cube into the hand anew",
               "the cube fell or was taken away; a gripper without power"},
    FaultEntry{kCubeMisread, "cube_misread", FaultClass::non_fatal, "what the camera reads cannot be the state of a cube", "look at the light and at the stickers, or tell the state with --eyes none",
               "glare or coloured light; a sticker that is missing or dirty; a cube that was taken apart"},
};
// clang-format on
inline const RegisteredFaults kRegisteredFaults{kFaults};

}  // namespace mrroc::rubik
