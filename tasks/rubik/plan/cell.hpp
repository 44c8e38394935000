// The planner's interface to the arms and their surroundings; an interface, since tasks do not depend on
// robots.
#pragma once
#include <array>
#include <optional>

#include "tasks/rubik/plan/plan.hpp"

namespace mrroc::rubik {

/// Two arms and a cube at one instant.
struct CellState {
  ArmJoints joints;              ///< where both arms are
  std::array<double, 2> jaws{};  ///< distances [m], by index(Hand)
  Grasp grasp;                   ///< of the hand in which the cube is
  bool touched{};                ///< the other hand is about to grip it or has let go: it may touch the cube
  bool looked_at{};              ///< nothing may stand between the camera and the place of the shown face
};

/// Place where faces are shown to a camera.
struct Viewing {
  /// The frame G of the shown face: origin in its middle, z out of it; x and y along the edges of
  /// the face. Which way up the face is does not matter.
  Pose T_UG;
  double distance{0.45};  ///< of the camera from a face that is square to it [m]
  /// The frame V of such a face: the camera stands on its z, at that distance. G may be tilted against it.
  Pose T_UV;
};

/// Place where faces are turned. The frame M has its origin in the middle of the cube and z out of the face
/// that the postument keeps, away from the track arm.
struct Meeting {
  Pose T_UM;         ///< in the world
  ArmJoints joints;  ///< of both arms there, with their E's aligned with M: the branch that is meant
};

/// Constant; used by one thread at a time.
class PlanCell {
 public:
  virtual ~PlanCell() = default;

  /// @return where the arms meet
  [[nodiscard]] virtual const Meeting& meeting() const = 0;
  /// @return where faces are shown; null: nowhere
  [[nodiscard]] virtual const Viewing* viewing() const = 0;
  /// @return what free motions of an arm keep to
  [[nodiscard]] virtual const SpeedLimits& limits(Hand hand) const = 0;
  /// @return motors of an arm [rad], from joints within the limits
  [[nodiscard]] virtual AxisVector motors(Hand hand, const AxisVector& joints) const = 0;
  /// @return the inverse of it [rad, track m]
  [[nodiscard]] virtual AxisVector joints(Hand hand, const AxisVector& motors) const = 0;
  /// @return T_UE, E of a hand in the world
  [[nodiscard]] virtual Pose forward(Hand hand, const AxisVector& joints) const = 0;
  /// @param near  decides the branch, the turns of the angles and the place on the track
  /// @return joints with E there; nothing: out of reach
  [[nodiscard]] virtual std::optional<AxisVector> inverse(Hand hand, const Pose& T_UE,
                                                          const AxisVector& near) const = 0;
  /// @return distance from the nearest limit of a joint or motor, as a share of half its range; negative: beyond
  [[nodiscard]] virtual double joint_limit_margin(Hand hand, const AxisVector& joints) const = 0;
  /// @return how far the wrist is from its singularity: 0 at it, 1 farthest away
  [[nodiscard]] virtual double manipulability(Hand hand, const AxisVector& joints) const = 0;
  /// @return whether nothing comes nearer to anything than it should
  [[nodiscard]] virtual bool is_free(const CellState& state) const = 0;
};

}  // namespace mrroc::rubik
