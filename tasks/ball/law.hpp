// The law of the pair of arms: how the second palm presses, how the first keeps its place, how both share the load and yield.
#pragma once
#include <array>

#include "base/axis_command.hpp"
#include "tasks/ball/ball.hpp"

namespace mrroc::ball {

/// What both palms feel and where they are, in the world.
struct PairState {
  std::array<Pose, kArms> T_UE;         ///< of the palms
  std::array<double, kArms> press{};    ///< force along z of each palm [N]
  std::array<Vector3, kArms> across{};  ///< force across the line that each exerts [N]
  double distance{};                    ///< of the palms [m]
};

/// @param reports  of both arms
[[nodiscard]] PairState pair_state(const Parameters& k, const std::array<Report, kArms>& reports);

/// What a person adds to one arm, its own sensor feels, and the object does not: of two forces one is that on the object. It is
/// the larger one when the palms are nearer to each other than they are when nobody pushes.
/// @param closed  distance of the palms when nobody pushes [m] @return force of the palms on the object [N]
[[nodiscard]] double contact_force(const PairState& state, double closed);

/// Where an arm is wanted.
struct PalmGoal {
  Vector3 place{Vector3::Zero()};     ///< when the present reply was made [m]
  Vector3 velocity{Vector3::Zero()};  ///< from now on [m/s]
};

/// Rows across the line and about all axes: UNGUARDED, towards the goal. The row along z is left at rest.
[[nodiscard]] TaskFrameCommand hold_place(std::size_t arm, const Pose& T_UE, const PalmGoal& goal);

/// The row along z of the palm that presses: CONTACT, wherever that leads.
[[nodiscard]] AxisCommand press(double force);
/// The same of the first palm, which keeps the pair in its place: the middle between the palms is drawn to its goal.
[[nodiscard]] AxisCommand press_in_place(double force, const PairState& state, const Vector3& goal);

/// @return shift of the palms one macrostep later: the one that bears more gives way
[[nodiscard]] Vector3 share_load(const Vector3& shift, const PairState& state);

/// @param pushed  force of a person on the pair, across [N]
/// @return how far the pair has yielded one macrostep later [m]
[[nodiscard]] Vector3 yield(const Vector3& yielded, const Vector3& pushed);

/// @return force of a person on the pair, across [N]: what the palms bear less than the load; zero below what is noise
[[nodiscard]] Vector3 pushed_by_hand(const PairState& state, double load);

}  // namespace mrroc::ball
