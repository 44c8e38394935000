// Decides which wall a pair of master and slave bears: both arms under law (28), a coordinator that is late and works once in a
// macrostep, a hand at the master, a wall at the slave. The linear loop in discrete time, without passivity control.
//
// The master is CONTACT and feels the slave's force, the slave is GUARDED and follows the master's way:
//
//     F_d = - force_scale F_s,    v_d = fed + return_rate (place - x_s),    place = motion_scale x_m,
//     fed += dt / (dt + smoothing) (change of place / dt - fed),             dt a macrostep
//
// with a channel's delay in F_s and x_m, and latency::kLoop from a motion to the motion that answers it.
#pragma once
#include "edp/stability.hpp"

namespace mrroc::edp {

/// A pair, along one axis.
struct PairLoop {
  ContactLoop master{.inertia = 8,
                     .mobility = 0.003};  ///< the arm at the hand; its contact_damping does not count
  ContactLoop slave{.inertia = 2, .mobility = 0.0025};  ///< the arm at the wall; both have the same dt
  double hand_stiffness{1000};                          ///< of the hand at the master [N/m], > 0
  double hand_damping{30};                              ///< of the hand [N s/m], >= 0
  double motion_scale{1};                               ///< way of the slave over way of the master, > 0
  double force_scale{1};                                ///< force on the master over force of the slave, > 0
  double return_rate{12};                               ///< [1/s], > 0
  double smoothing{0.02};                               ///< of the velocity that the slave is fed [s], >= 0
  double delay{};                                       ///< of the channel, each way [s], 0..0.2
  int n_s{2};                                           ///< steps of a macrostep, 2..20; n_Q is one less
};

/// @param stiffness  of the wall [N/m], > 0 @return largest magnitude of an eigenvalue of a macrostep; stable below 1
/// @throw FaultError out_of_limits a parameter makes no sense; its text names it
[[nodiscard]] double pair_radius(const PairLoop& pair, double stiffness);

/// @param late  more delay that the channel may have [s], >= 0
/// @return whether the pair is stable on that wall and on one half as stiff again, a push dies away by e within two seconds, and
///         nothing is later than 20 ms: what may be left without a bound on how fast forces grow
/// @throw FaultError out_of_limits
[[nodiscard]] bool pair_settles(PairLoop pair, double stiffness, double late);

/// Stiffnesses among which a limit is looked for [N/m].
inline constexpr double kSoftestWall = 10, kStiffestWall = 1e7;

/// @return smallest stiffness of the wall with which the pair is not stable [N/m]; 0: none is, infinite: all are up to
///         kStiffestWall
/// @throw FaultError out_of_limits
[[nodiscard]] double pair_stiffness_limit(const PairLoop& pair);

/// J. E. Colgate, G. G. Schenkel: Passivity of a class of sampled-data systems: application to haptic interfaces, J. Robotic
/// Systems 14 (1997) 37-47: a haptic interface of damping b that feels a wall of stiffness K, sampled with T, is passive when
/// b > K T / 2 + B with the virtual damping B, here 0. It knows of no delay beyond that of sampling, of no arm that follows and
/// of no damping of the wall itself, and it holds for any hand. It stands beside the limit of the loop to compare with: neither
/// bounds the other, since a wall that damps well may be stable with one hand and not passive for all.
/// @return K for b = 1 / B of the master, T a macrostep, as a stiffness of the slave's wall [N/m]
[[nodiscard]] double colgate_bound(const PairLoop& pair);

}  // namespace mrroc::edp
