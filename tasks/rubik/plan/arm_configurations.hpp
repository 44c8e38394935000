// The few configurations of the gripping arms from which plans are made.
#pragma once
#include <optional>
#include <vector>

#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::rubik {

/// Orientation of a hand in the frame M.
enum class Place : std::uint8_t {
  front,  ///< z of E along the axis of M, y along x or y of M: both arms there turn a face
  side,   ///< z of E perpendicular to that axis: this hand comes, the other one offers the cube
  offered,  ///< z of E along the axis, so turned about it that the other hand's fingers fit beside its own from the side
  shown,  ///< a face of the cube in this hand is before the camera
  start   ///< wherever the arm was at the beginning
};

/// One configuration of an arm. The cube is always at the same place, unless it is shown.
struct ArmConfiguration {
  Place place{};    ///< decides what the hand can do here
  AxisVector hold;  ///< E at the grip
  std::vector<AxisVector>
      path;  ///< straight to the cube: from kRetreatDistance to kApproachDistance before contact
  Vector3 shown{Vector3::Zero()};  ///< out of the face that the camera sees, in E

  /// @return drawn back
  [[nodiscard]] const AxisVector& back() const { return path.front(); }
};

/// Margins that key postures keep.
struct ConfigurationMargins {
  double limits{0.08};         ///< PlanCell::joint_limit_margin
  double manipulability{0.3};  ///< PlanCell::manipulability, where a hand works
};

/// @return all postures of a hand; in place front: in steps of a quarter turn, over all turns of the last joint. There
///         is no posture `side` (and `offered` of the other hand) when it cannot come from any side
[[nodiscard]] std::vector<ArmConfiguration> find_configurations(const PlanCell& cell, Hand hand,
                                                                const ConfigurationMargins& margins = {});

/// @param hold  joints at the grip @return the path of a posture; nothing: it leaves the limits
[[nodiscard]] std::optional<std::vector<AxisVector>> find_path(const PlanCell& cell, Hand hand,
                                                               const AxisVector& hold,
                                                               const ConfigurationMargins& margins);

}  // namespace mrroc::rubik
