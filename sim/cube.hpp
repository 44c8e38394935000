// A Rubik's cube in the work cell: its parameters and its true state.
#pragma once
#include <array>
#include <cstdint>

#include "base/cube/cube.hpp"
#include "base/cube/grasp.hpp"
#include "base/pose.hpp"
#include "sim/face_friction.hpp"

namespace mrroc::sim {

/// Edge of the original's cube [m].
inline constexpr double kCubeEdge = cube::kEdge;

/// The frame of the cube, C, is fixed to its core: origin in the middle, x out of face R, z out of face U, so y comes
/// out of face B. At the beginning an arm holds it.
struct CubeParameters {
  double edge{kCubeEdge};      ///< [m]
  double mass{0.1};            ///< [kg]
  double added_inertia{1e-3};  ///< of each layer, for the solver's sake (docs/plant.md) [kg m^2]
  double friction{1};          ///< of the stickers; that of a contact is the product with the pad's
  cube::Cube state;            ///< the stickers
  FaceFrictionSpread faces;    ///< of the six faces
  int held_by{};               ///< number of the arm that holds it at the beginning
  Pose T_EC{Matrix3::Identity(), {0, 0, 0.019}};  ///< of the cube in that hand
};

/// The true state, for tests and figures.
struct CubeTruth {
  Pose T_UC;         ///< in the world
  cube::Cube state;  ///< the stickers, every face at the seat to which it is nearest
  int axis{};        ///< about which layers can turn now: 0 x, 1 y, 2 z of C
  std::array<double, 2>
      angle{};  ///< of the layers in positive and negative direction of that axis, from the seats
                ///< that `state` has them in; positive: counterclockwise seen from outside [rad]
  std::array<double, 2> torque{};  ///< which the friction of these faces bears [N m]
  double squeeze{};  ///< largest force with which one pad, palm or the floor pressed on it in the step [N]
  int layings{};     ///< how often the layers have been chosen anew
  bool on_floor{};   ///< it touched the floor in the step
};

}  // namespace mrroc::sim
