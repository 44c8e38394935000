// The simulated cell in which two arms handle a cube, for tests and benchmarks.
#pragma once
#include <cstdint>

#include "base/cube/fingers.hpp"
#include "sim/world.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Numbers of the arms in this cell.
inline constexpr int kPostument = 0;
inline constexpr int kTrack = 1;

/// Parameters that differ from one turn to another.
struct CubeCellParameters {
  Cube state;                            ///< the stickers at the beginning
  Face face{Face::U};                    ///< that the arm on the pedestal turns
  sim::FaceFrictionSpread faces;         ///< friction of the faces
  double distance{0.01};                 ///< of the worker's palm from the cube [m]
  Vector3 grasp_error{Vector3::Zero()};  ///< of the worker across its approach [m]: x, y of E; z: none
  double turn_error{};                   ///< of the worker about its approach [rad]
  double jaws{0.074};                    ///< of the worker at the beginning [m]
};

/// Of the contact solver in this cell: enough, since it remembers (sim/bullet/contact_solver.hpp).
inline constexpr int kCubeIterations = 50;

/// @return the track arm holds the cube, the arm on the pedestal stands before it
/// @throws std::invalid_argument  the arms do not reach each other
sim::WorldParameters cube_cell(const CubeCellParameters& c);

/// Weight and mass centre of a tool with the cube in its hand, for SET FORCE_TOOL.
struct LoadedTool {
  double weight{};                       ///< [N]
  Vector3 mass_centre{Vector3::Zero()};  ///< W_G P [m]
};
/// @param arm  as above @param cube  of the simulator
LoadedTool tool_with_cube(int arm, const sim::CubeParameters& cube);

}  // namespace mrroc::rubik
