// Accuracy of the inverse kinematics over the whole workspace.
#pragma once

namespace mrroc::bench {

/// Results of FK(IK(x)) over random poses.
struct RoundTrips {
  long poses{};      ///< tried, over all kinematic models of both arms
  long solutions{};  ///< asked for, several of each pose
  long
      failures{};  ///< not reached, a pose off by more than 1e-9, another branch than asked for, beyond limits
  double largest{};  ///< error of a pose: of a coordinate [m] or an element of the rotation matrix
};

/// Random poses with the motors within their limits, seeded. Of each, all solutions (both signs of sin q5,
/// both bends of the elbow, the arm to the front and leaning over its back: eight, four where the arm is too
/// short to reach the pose with its hand the other way) are asked for by the joints
/// given as near, and once the one nearest to other joints within the limits, which must lie within them.
/// @param poses  altogether; every kinematic model of every arm gets the same share
RoundTrips run_round_trips(long poses);

}  // namespace mrroc::bench
