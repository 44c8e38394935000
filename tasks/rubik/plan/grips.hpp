// Grips of a cube at the place where the arms meet: poses T_UE, before any arm is asked for its joints.
#pragma once
#include <vector>

#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::rubik {

/// @return a turn about z [rad]
[[nodiscard]] Pose turn_about_z(double angle);
/// @return a displacement along z [m]
[[nodiscard]] Pose along_z(double distance);

/// @return T_UE of a hand that grips in front, with E aligned with M
[[nodiscard]] Pose front_grip(const Meeting& meeting, Hand hand);

/// T_UE of both hands when one comes from the side to a cube that the other one offers.
struct SideGrip {
  Pose comes;   ///< of the hand that comes
  Pose offers;  ///< of the other one: z along the axis of M, so turned that the fingers of both fit
};

/// @param comes  the hand that comes from the side
/// @param angle  of the direction in which it comes, about z of M from its x [rad]
[[nodiscard]] SideGrip side_grip(const Meeting& meeting, Hand comes, double angle);

/// @param joints  of an arm
/// @return these joints with the track at every place from which a grip is tried, up to 0.6 m to either side; of an arm
///         without a track: these joints alone
[[nodiscard]] std::vector<AxisVector> along_track(const AxisVector& joints);

}  // namespace mrroc::rubik
