// Direct and inverse kinematics of the IRb-6, both analytic.
#pragma once
#include "base/axes.hpp"
#include "base/pose.hpp"
#include "edp/robot.hpp"
#include "robots/irb6/directions.hpp"
#include "robots/irb6/parameters.hpp"

namespace mrroc::irb6 {

/// The kinematics of one arm. With the absolute angles theta3 = q2 + q3 + pi/2 and theta4 = theta3 + q4 (the
/// linkages hold the links by them), and the arm's plane spanned by h = (cos q1, sin q1, 0) and z:
///
///     p = h (a2 cos q2 + a3 cos theta3 + d5 cos theta4) + z (z_offset - a2 sin q2 - a3 sin theta3 - d5 sin
///     theta4) R = Rot(z, q1) Rot(y, theta4) Rot(x, q5) B Rot(z, q6),   B = [e_z e_x e_y]
///
/// The z axis of W points out of the tool; it points down for theta4 = 0, q5 = 3/2 pi. The track moves the
/// base of the arm along y. Every function is real-time safe.
class Kinematics {
 public:
  /// @param arm  its lengths are copied
  explicit Kinematics(const ArmParameters& arm) noexcept;

  /// @param joints [rad, track m], as many as the arm has axes; what is not finite gives a pose that is not
  /// @return T_0W, the wrist in the base; z = 0 is the floor
  [[nodiscard]] Pose forward(const AxisVector& joints) const noexcept;
  /// The same from where the links point.
  [[nodiscard]] Pose forward(const Directions& links) const noexcept;

  /// The manipulator Jacobian: d(0_W v)/d(dq/dt).
  /// @param joints [rad, track m], as many as the arm has axes
  /// @return one column per axis: velocity of the origin of W [m] and angular velocity of W [1], both along the
  ///         axes of the base, per unit of the joint's speed
  [[nodiscard]] Jacobian jacobian(const AxisVector& joints) const noexcept;

  /// All branches (both signs of sin q5, both bends of the elbow, the arm turned to the front or leaning over
  /// its back) and all turns of each angle are considered, and of those within the motor limits the one
  /// nearest to `near` is taken. But where `near` is less than 0.05 rad away (all angles together), as along
  /// a path, that solution is taken whatever the limits: a path never jumps. The arm leans back, and the
  /// elbow bends the other way, only where `near` does so. Singular: q4 (hand along the arm's normal) or q1
  /// (wrist above the column) stays where `near` has it. The track stands where ArmParameters::track_rule and
  /// `near` put it.
  ///
  /// @param T_0W wrist in the base, a rotation and a position
  /// @param near joints [rad, track m], as many as the arm has axes
  /// @return joints, finite whatever the arguments are. Out of reach: the arm stretched (or folded) towards
  ///         the position. Arguments that are not finite, larger than 1e6, or of another size: not reached,
  ///         missing is infinite and the joints are 0.
  [[nodiscard]] edp::InverseSolution inverse(const Pose& T_0W, const AxisVector& near) const noexcept;

 private:
  // The six angles that the analytic solution works with.
  struct Angles {
    double theta1, theta2, theta3, theta4, q5, q6;
  };
  // Intervals of the angles in which the motors are within their limits.
  struct Legal {
    edp::Range track, theta1, theta2, theta3, theta4, q6;
    edp::Range q5_at_zero;   // for theta4 = 0
    double q5_per_theta4{};  // the interval moves with T
  };
  // The plane in which the arm stands, and the wrist's signed distance from the column in it.
  struct Plane {
    double theta1, c1, s1, radius;
    bool singular;
  };
  // One choice of branches.
  struct Branch {
    Angles angles;
    double missing{};  // [m] out of reach
    double cost{};     // distance from the given joints and penalties
    double track{};    // [m]
    bool singular{};
  };

  [[nodiscard]] Angles angles(const AxisVector& joints) const noexcept;
  // x, y: wrist in the base of the column.
  [[nodiscard]] Plane plane(double x, double y, const Angles& near) const noexcept;
  // Shoulder and elbow of a branch. height: of the wrist above the shoulder; c4, s4: of its theta4.
  void elbow(Branch& b, double c4, double s4, double radius, double height,
             const Angles& near) const noexcept;
  // The turns of all angles nearest to the given ones, if together they are a step of a path.
  [[nodiscard]] static bool take_path_step(Angles& a, const Angles& near) noexcept;
  // The turns of all angles within the limits nearest to the given ones, and what that costs.
  void take_legal_turns(Branch& b, const Angles& near) const noexcept;

  // The best branch with the track at a place.
  [[nodiscard]] Branch solve(const Pose& T_0W, double track, const Angles& near) const noexcept;
  // Where the rule puts the track; where it is ill-conditioned, as given.
  [[nodiscard]] double place_track(const Pose& T_0W, double track, const Angles& near) const noexcept;

  Lengths k_;
  TrackRule track_rule_;
  int first_;
  int count_;
  Legal legal_;
};

}  // namespace mrroc::irb6
