// The way of the simulated operator's hand: a circle through the air, then against the side of the slave's plate, then down onto it.
#pragma once
#include <vector>

#include "mp/hand_file.hpp"
#include "tasks/haptic/config.hpp"

namespace mrroc::haptic {

/// What the hand has to know of both cells. Sheets: x to the right, y away from the arm, z up.
struct Scene {
  Pose T_0P;              ///< sheet of the master in its base
  double height{};        ///< of both tools above their sheets at the beginning [m]
  double side{};          ///< y of the slave's tool when it touches the near side of the plate [m]
  double top{};           ///< z of the slave's tool when it touches the top of the plate [m]
  double depth{};         ///< from the near side to the far one [m]
  double stiffness{1e4};  ///< of what the slave meets [N/m]
  double compliance{};    ///< of the hand, from where it wants to be to the tool [m/N]
};

/// @return a point every 10 ms, in the base of the master
/// @throws FaultError bad_configuration  the master would go into its table
[[nodiscard]] std::vector<mp::WayPoint> hand_way(const Scene& scene, const Law& law,
                                                 const OperatorPlan& plan);

}  // namespace mrroc::haptic
