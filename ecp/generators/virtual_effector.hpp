// The virtual effector e_1 of visual servoing (VS 3.2) on the driver's relative commands.
//
// VS (16)-(18), (26), (27)                                        the driver
// e_B_1,1: 0_E T_d = 0_E T_c E T_d,c in the first step           SET ARM, MIM, relative pose: planned from the set pose
// inverse kinematics, branch nearest to Theta_p                  the same, nearest to the set joints
// (m_d - m_c) / (steps left) in every step                       the motors' straight line, n_s steps
// ends at iota_s + 21 without, at iota_s + 19 with new data      macrosteps of n_s steps follow without a gap
// e_B_1,0: servo on m_d                                           no SET ARM: comes to rest at m_d, holds
// output 0_E T_c in every step                                    samples of all steps, and the number of the last
//
// The motion is planned from the set motors where (26), (27) take the measured ones: the lag of the drives would be
// subtracted from every displacement.
#pragma once
#include "base/effector_command.hpp"
#include "base/representation.hpp"
#include "ecp/generators/rows.hpp"

namespace mrroc::ecp {

/// Steps of e_B_1,1: a little longer than the period of a camera of 25 Hz, so that there is a new image in every
/// motion and one that comes late does not stop it.
inline constexpr Pacing kDisplacementPacing{.n_s = 21, .n_Q = 20};

/// y_ce of e_B_1,1: a displacement in n_s steps, without a stop when the next one follows.
/// @param T_dc  E T_d,c: the desired pose of E in where E is told to be when the motion begins
[[nodiscard]] inline EffectorCommand displace(const Pose& T_dc, const Pacing& pacing = kDisplacementPacing) {
  ArmCommand arm;
  arm.mu = Interpolation::mim;
  arm.representation = Representation::frame;
  arm.reference = Reference::relative;
  arm.pose = numbers_from_pose(Representation::frame, T_dc);
  arm.n_s = pacing.n_s;
  arm.n_Q = pacing.n_Q;
  return move_arm(arm);
}

/// @return E T_d,c of a command that displace() has made, or of a part of it; identity for any other command
[[nodiscard]] inline Pose displacement_of(const EffectorCommand& command) {
  const bool displaces = has(command.set, Part::arm) && command.arm.mu == Interpolation::mim &&
                         command.arm.reference == Reference::relative;
  if (!displaces) return {};
  return pose_from_numbers(command.arm.representation, command.arm.pose).value_or(Pose{});
}

/// y_ce of e_B_1,0: nothing; the arm comes to rest where the last displacement leads to, and holds.
[[nodiscard]] constexpr EffectorCommand idle() { return rest(); }

}  // namespace mrroc::ecp
