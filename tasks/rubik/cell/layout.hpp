// The places where the arms meet and where faces are shown to the camera.
#pragma once
#include "base/axes.hpp"
#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::rubik {

/// Where the cube is held while a face is turned, the frame M: origin in the middle of the cube, z out of the face that
/// the arm on the pedestal turns, away from the track arm. Found by
/// a search over places, directions, turns about them and positions of the track: the least margin, as
/// bench/meeting_search.hpp has it, is 0.43 over both arms' grips in all
/// four quarter turns, their retreats by 0.1 m, and a grip of the track arm from a side of the cube.
[[nodiscard]] Pose meeting_place();

/// @param arm  by index(Hand)
/// @return joints of that arm there, as good as it gets: a start for the inverse kinematics [rad, track m]
[[nodiscard]] AxisVector meeting_joints(int arm);

/// Where the cube is shown to the camera: its middle stays at the meeting place, the face looks up at the camera by 20
/// degrees, away from the arms' row. Of 1008 places and directions it is the one in which both arms can show the face
/// opposite to the palm and the two that are free of fingers with the least motion.
/// @param reading  0: faces are square to the camera; from 1 on they are tilted, so that lamps that they mirrored are elsewhere
[[nodiscard]] Viewing viewing_place(int reading = 0);

/// @param arm  by index(Hand)
/// @return T_ME of the grip of that arm
[[nodiscard]] Pose grip(int arm);

}  // namespace mrroc::rubik
