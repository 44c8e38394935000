// The coupling of two arms: the master's way goes to the slave, the slave's force comes back, both through a channel that
// is kept passive. Pure functions, without arms.
#pragma once
#include <cstdint>

#include "tasks/haptic/channel.hpp"
#include "tasks/haptic/passivity.hpp"

namespace mrroc::haptic {

/// How an arm gives way: I and B of law MG (28), the same along x, y and z.
struct Compliance {
  double inertia{};   ///< I [kg]
  double mobility{};  ///< B [s/kg]
};

/// Gains of a pair.
struct Law {
  double motion_scale{1};                              ///< way of the slave per way of the master
  double force_scale{1};                               ///< force on the master per force of the slave
  Compliance master{.inertia = 8, .mobility = 0.003};  ///< CONTACT: of the arm that is led
  Compliance slave{.inertia = 2, .mobility = 0.0025};  ///< GUARDED: of the arm that follows
  double return_rate{12};   ///< k: the slave returns to its place with k times its distance [1/s]
  double smoothing{0.02};   ///< time constant of the velocity that it is fed [s]
  double catch_up{0.03};    ///< so much faster than the master it takes up what was kept back [m/s]
  double most_speed{0.15};  ///< of the slave [m/s]
  double most_force{30};    ///< on the master, and of the slave [N]
  double least_force{0.3};  ///< of the slave: less than this is noise, twice this is all felt [N]
  /// What is not known to be stable by itself, because it is late or the wall is stiff, goes on and off with the motion that
  /// it makes itself. The force on the master then grows no faster than this spring and rate; it drops at once.
  bool grows_gently{true};
  double grow_stiffness{5000};  ///< [N/m]
  double grow_rate{5};          ///< [N/s]
  ChannelParameters channel;    ///< each way
  PassivityLaw passivity;       ///< of both ports
  double macrostep{0.004};      ///< duration [s]
};

/// What the arms report, in the base of each, turned alike.
struct Sides {
  Vector3 x_m{Vector3::Zero()};  ///< way of the master since the arms were coupled [m]
  Vector3 x_s{Vector3::Zero()};  ///< way of the slave [m]
  Vector3 F_s{Vector3::Zero()};  ///< that the slave exerts [N]
};

/// State of the coupling, and what it has decided last.
struct Coupling {
  Channel there, back;             ///< from the master to the slave, and from the slave to the master
  PortEnergy master, slave;        ///< of the channel's ends
  Vector3 x_m{Vector3::Zero()};    ///< in the macrostep before [m]
  Vector3 asked{Vector3::Zero()};  ///< where the slave is to be, as heard of the master [m]
  Vector3 place{Vector3::Zero()};  ///< where it may be: what came out of the channel [m]
  Vector3 fed{Vector3::Zero()};    ///< velocity that the slave is fed [m/s]
  Vector3 v_d{Vector3::Zero()};    ///< of the slave, GUARDED [m/s]
  Vector3 F_d{Vector3::Zero()};    ///< of the master, CONTACT [N]
  std::int64_t age{};              ///< of the newest packet at the slave, in macrosteps
};

/// @return the coupling of two arms that have not moved yet
[[nodiscard]] Coupling coupled(const Law& law);

/// One macrostep.
/// @param i     number of the macrostep
/// @param pace  of task time, 0..1: at 0 the place of the slave stands
[[nodiscard]] Coupling couple(Coupling c, const Law& law, const Sides& sides, std::int64_t i,
                              double pace = 1);

/// @return the force that is sent back: without what is noise
[[nodiscard]] Vector3 felt(const Law& law, const Vector3& F_s);

}  // namespace mrroc::haptic
