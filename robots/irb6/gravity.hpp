// The torques of an IRb-6's weight at its motors.
#pragma once
#include "base/axes.hpp"
#include "robots/irb6/parameters.hpp"
#include "robots/irb6/transmission.hpp"

namespace mrroc::irb6 {

/// A link: its mass, and where its mass centre lies along it.
struct LinkMass {
  double mass;    ///< [kg]
  double centre;  ///< [m] from the joint at its beginning towards its end; wrist body and wrist: along z of W
};

/// Masses of the links that gravity turns. Estimates, the same as in irb6_*.urdf, which tell where they come from.
struct LinkMasses {
  /// Each with the joint it begins at: shoulder, elbow, wrist; the wrist body and the wrist as LinkMass says.
  LinkMass lower_arm{13.849542, 0.23};
  LinkMass upper_arm{18.7778341, 0.0968952};
  LinkMass wrist_fork{1.7671419, 0.0585};
  LinkMass wrist_body{3.28689131, -0.115};
  LinkMass wrist{1.92378568, 0.07};
};

/// Gravity of an arm with its default tool. The links hang on absolute angles (Kinematics), so the potential is
///
///     V = -g (m_2 sin theta2 + m_3 sin theta3 + m_4 sin theta4 - m_5 cos theta4 sin q5)
///
/// with moments m_i of masses. The small offset of the tool's mass centre from z of W is left out.
class Gravity {
 public:
  /// @param arm  its lengths and gears are copied
  explicit Gravity(const ArmParameters& arm) noexcept;

  /// Torques of the motors that hold the arm still: grad V through the transmission. Real-time safe.
  /// @param motors [rad], inside the domain of the linkages  @param transmission of the same arm
  /// @return [N m] at the shafts
  [[nodiscard]] AxisVector torques(const AxisVector& motors, const Transmission& transmission) const noexcept;

 private:
  int first_;
  int count_;
  double g2_, g3_, g4_, g5_;  // weights of the moments [N m]
  double gear_T_, gear_V_;
};

}  // namespace mrroc::irb6
