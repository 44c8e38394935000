// The cell in which two arms handle a cube: where they meet, and what their grippers are like.
#pragma once
#include <cstdint>

#include "sim/world.hpp"
#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::sim {

/// Numbers of the arms in this cell.
inline constexpr int kPostument = 0;
inline constexpr int kTrack = 1;

/// Depth of a grip: how far E is from the middle of the cube, towards the arm, when the palm lies on the cube [m]. The
/// track arm's long fingers hold two layers, those of the arm on the pedestal one: so it is always that one which
/// turns.
inline constexpr double kOneLayer = rubik::depth(rubik::Hand::postument);
inline constexpr double kTwoLayers = rubik::depth(rubik::Hand::track);

/// How many layers of a cube the fingers of a gripper cover.
enum class Fingers : std::uint8_t { one_layer, two_layers };
/// @return a gripper with such fingers, whose palm lies on the cube when they cover it
GripperBodyParameters gripper_with(Fingers fingers);
/// @param face  that points away from the palm
/// @return T_EC of a cube in such a hand
Pose cube_in_hand(Fingers fingers, rubik::Face face);

/// Where the cube is held while a face is turned, the frame M: origin in the middle of the cube, z out of the face that
/// the arm on the pedestal turns, away from the track arm. Found by
/// a search over places, directions, turns about them and positions of the track: the least margin, as
/// bench/meeting_search.hpp has it, is 0.43 over both arms' grips in all
/// four quarter turns, their retreats by 0.1 m, and a grip of the track arm from a side of the cube.
Pose meeting_place();

/// @param arm  kPostument or kTrack
/// @return joints of that arm there, as good as it gets: a start for the inverse kinematics [rad, track m]
AxisVector meeting_joints(int arm);

/// Where the cube is shown to the camera: its middle stays at the meeting place, the face looks up at the camera by 20
/// degrees, away from the arms' row. Of 1008 places and directions it is the one in which both arms can show the face
/// opposite to the palm and the two that are free of fingers with the least motion.
/// @param reading  0: faces are square to the camera; from 1 on they are tilted, so that lamps that they mirrored are elsewhere
rubik::Viewing viewing_place(int reading = 0);

/// @param arm  kPostument or kTrack
/// @return T_ME of the grip of that arm
Pose grip(int arm);

/// @param face  that the arm on the pedestal turns
/// @return T_MC of a cube that is held so
Pose cube_with(rubik::Face face);

/// What differs from one turn to another.
struct CubeCellParameters {
  rubik::Cube state;                     ///< the stickers at the beginning
  rubik::Face face{rubik::Face::U};      ///< that the arm on the pedestal turns
  FaceFrictionSpread faces;              ///< friction of the faces
  double distance{0.01};                 ///< of the worker's palm from the cube [m]
  Vector3 grasp_error{Vector3::Zero()};  ///< of the worker across its approach [m]: x, y of E; z: none
  double turn_error{};                   ///< of the worker about its approach [rad]
  double jaws{0.074};                    ///< of the worker at the beginning [m]
};

/// Of the contact solver in this cell: enough, since it remembers (sim/bullet/contact_solver.hpp).
inline constexpr int kCubeIterations = 50;

/// @return the track arm holds the cube, the arm on the pedestal stands before it
/// @throws std::invalid_argument  the arms do not reach each other
WorldParameters cube_cell(const CubeCellParameters& c);

/// Weight and mass centre of a tool with the cube in its hand, for SET FORCE_TOOL.
struct LoadedTool {
  double weight{};                       ///< [N]
  Vector3 mass_centre{Vector3::Zero()};  ///< W_G P [m]
};
/// @param arm  as above @param cube  of the world
LoadedTool tool_with_cube(int arm, const CubeParameters& cube);

}  // namespace mrroc::sim
