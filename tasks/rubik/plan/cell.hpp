// What the planner knows of the arms and of what stands around: an interface, since tasks do not depend on robots.
#pragma once
#include <span>
#include <vector>

#include "tasks/rubik/plan/plan.hpp"

namespace mrroc::rubik {

/// Speeds of one arm.
struct JointLimits {
  AxisVector lower, upper;            ///< that free motions keep [rad, track m]: within those of the robot
  AxisVector velocity, acceleration;  ///< [rad/s, m/s] and [rad/s^2, m/s^2]
};

/// Two gripping arms, their grips and a cube, for a collision check.
struct CellState {
  ArmJoints joints;
  std::array<double, 2> jaws{};  ///< distances [m], by index(Hand)
  Hand carrier{};                ///< hand in which the cube is
  Grasp grasp;                   ///< of that hand
};

/// Constant; functions may be called by one thread at a time.
class PlanCell {
 public:
  virtual ~PlanCell() = default;

  /// @return limits of an arm
  [[nodiscard]] virtual const JointLimits& limits(Hand hand) const = 0;
  /// @return T_UE, E of a hand in the world
  [[nodiscard]] virtual Pose forward(Hand hand, const AxisVector& joints) const = 0;
  /// @return joints with E there, on the branch of `near` and nearest to it, the track as there; within the limits.
  ///         Nothing: out of reach
  [[nodiscard]] virtual std::optional<AxisVector> inverse(Hand hand, const Pose& T_UE,
                                                          const AxisVector& near) const = 0;
  /// @return distances from limits and from the wrist's singularity, smallest, as a share of half the range: 0..1
  [[nodiscard]] virtual double margin(Hand hand, const AxisVector& joints) const = 0;
  /// @return whether nothing is nearer to anything than it should be
  [[nodiscard]] virtual bool is_free(const CellState& state) const = 0;
};

}  // namespace mrroc::rubik
