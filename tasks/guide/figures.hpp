// What a run is judged by: deviation and forces on the fixture, from the rows of the arm.
#pragma once
#include <vector>

#include "mp/arm_trace.hpp"
#include "tasks/guide/config.hpp"

namespace mrroc::guide {

/// A row of the arm that stands to the fixture, with forces that the operator's hand feels.
struct LedRow {
  double t{};                         ///< [s]
  int m{};                            ///< behaviour
  Standing standing;                  ///< of the tool
  Vector3 velocity{Vector3::Zero()};  ///< since the row before, in the base [m/s]
  Vector3 F{Vector3::Zero()};         ///< F_a in the base [N]: what the tool exerts on the hand
  double along{};   ///< F_a along the motion that is free [N]; of a plane the larger of both
  double across{};  ///< F_a across the fixture [N]
  double speed{};   ///< along what is free [m/s], signed of a curve
};

/// @return rows of behaviours in which the fixture holds: kEnter, kGuided, kLeave
[[nodiscard]] std::vector<LedRow> led_rows(const mp::ArmTrace& trace, const Setup& k);

/// @return of the first arm, see README.md
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config);

}  // namespace mrroc::guide
