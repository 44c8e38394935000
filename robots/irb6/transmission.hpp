// Converts motor positions to joints and back: gears, ball screws with linkages, and coupled axes.
#pragma once
#include "base/axes.hpp"
#include "robots/irb6/directions.hpp"
#include "robots/irb6/parameters.hpp"

namespace mrroc::irb6 {

/// Positions of all axes after a conversion.
struct Converted {
  AxisVector value;  ///< joints [rad, track m] or motors [rad]; not finite only where the argument is not
  bool inside{};     ///< false: a linkage was clamped at its dead centre, or an argument is not finite
};

/// The transmission of one arm.
///
/// The screws and the motor T act on absolute angles of the links, theta2 = q2, theta3 = q2 + q3 + pi/2,
/// theta4 = theta3 + q4, and the motor V turns along with T:
///
///     m_V = s_V + g_V (q5 - theta0_V) + (m_T - s_T)
///
/// No angle is wrapped anywhere, so motors and joints correspond one to one wherever inside is true.
/// Every function is real-time safe.
class Transmission {
 public:
  /// @param arm  its linkages and gears are copied
  explicit Transmission(const ArmParameters& arm) noexcept;

  /// @param joints [rad, track m], as many as the arm has axes @return motors [rad]
  [[nodiscard]] Converted motors(const AxisVector& joints) const noexcept;

  /// @param motors [rad], as many as the arm has axes @return joints [rad, track m]
  [[nodiscard]] Converted joints(const AxisVector& motors) const noexcept;

  /// Where the links point, without the way over the joints. Clamped like joints().
  /// @param motors [rad], as many as the arm has axes
  [[nodiscard]] Pitches pitches(const AxisVector& motors) const noexcept;
  /// The same of all links.
  [[nodiscard]] Directions directions(const AxisVector& motors) const noexcept;

  /// The matrix J = d motors / d joints. Speeds: dm = J dq; torques: tau_joint = J^T tau_motor.
  /// @param joints [rad, track m], inside the domain of the linkages
  /// @return [rad of the motor per rad or m of the joint], square
  [[nodiscard]] AxisMatrix jacobian(const AxisVector& joints) const noexcept;

  /// The gears of the ball screws, which change with the angle of the link: d m_1 / d theta2, d m_2 / d theta3.
  /// @param theta2,theta3 inside the domain of the linkages
  /// @return [rad of the motor per rad of the link]
  [[nodiscard]] double lower_arm_gear(Direction theta2) const noexcept;
  [[nodiscard]] double upper_arm_gear(Direction theta3) const noexcept;

 private:
  // l^2 = sl + r cos(theta + phi) with theta + phi in [-pi, 0]: there l grows with theta.
  struct Screw {
    double sl, mi, ni, r, phi, l_min, l_max;
    explicit Screw(const Linkage& k) noexcept;
    // Length of the screw side [mm] at an absolute angle; lowers inside when the angle is clamped.
    double length(double theta, bool& inside) const noexcept;
    // Absolute angle [rad] at a length; lowers inside when the length is clamped.
    double angle(double l, bool& inside) const noexcept;
    // Cosine and sine of that angle.
    Direction direction(double l) const noexcept;
    // dl / dtheta [mm/rad] at an angle; next to 0 beyond the dead centre.
    double slope(Direction theta) const noexcept;
  };

  int first_;
  int count_;
  std::array<Drive, kMostAxes> drive_;
  Screw lower_, upper_;
};

}  // namespace mrroc::irb6
