// Passivity observer and passivity controller in the time domain, at one port of a channel with delay.
//
// B. Hannaford, J.-H. Ryu: Time-domain passivity control of haptic interfaces, IEEE Trans. Robotics and Automation 18 (2002) 1-10;
// for two ports with delay between them: J.-H. Ryu, J. Artigas, C. Preusche: A passive bilateral control scheme for a
// teleoperator with time-varying communication delay, Mechatronics 20 (2010) 812-823.
//
// The energies of the two directions are counted apart. What went into the channel at one side is sent along; the
// other side lets no more come out than it has heard of. That holds whatever delay, jitter and loss are, since what was
// heard is old, and so never too much.
#pragma once
#include "base/spatial.hpp"

namespace mrroc::haptic {

/// How a port is watched.
struct PassivityLaw {
  bool control{true};    ///< the controller acts; false: the port is only observed
  double start{0.0005};  ///< energy that may come out before any has gone in [J]: what noise needs
  double surplus{
      0.005};  ///< energy that is saved at most [J]: more would be there for an oscillation to grow on
  double store{0.0005};  ///< largest energy of PortEnergy::store [J]
  double share{0.2};  ///< of the energy that the damping of the arm takes up which goes into the store, 0..1
};

/// Energies of one port since the beginning [J]. in, out and heard never fall.
struct PortEnergy {
  double in{};         ///< gone into the channel here
  double out{};        ///< come out of it here
  double heard{};      ///< gone in at the other side, as far as heard, in the scale of this side
  double given_up{};   ///< not saved, see PassivityLaw::surplus
  double kept_back{};  ///< what would have come out without the controller, less `out`
  double store{};      ///< gone in here and not sent on: what comes out again is taken from it first

  /// @return the observer's energy: passive is what stays at 0 or above
  [[nodiscard]] double observed() const { return heard - out; }
};

/// Takes note of what is heard of the other side.
/// @param heard  energy in the scale of this side [J]; what is less than before is old
[[nodiscard]] PortEnergy hear(PortEnergy port, const PassivityLaw& law, double heard);

/// One macrostep of a port.
struct Passed {
  PortEnergy port;
  Vector3 output{Vector3::Zero()};  ///< what the channel may put out
};

/// Of a force that the channel puts out against a velocity (impedance) or a velocity against a force (admittance): takes away
/// the part of the output along the input with which too much energy would come out. It is never turned round.
/// @param output  of the channel, and what it meets: force and velocity or the reverse, [N] and [m/s]
/// @param dt      for which both hold [s]
/// @param damped  energy that the damping of the arm has taken up in that time [J], which the hand or the wall has given
[[nodiscard]] Passed pass(PortEnergy port, const PassivityLaw& law, const Vector3& output,
                          const Vector3& input, double dt, double damped = 0);

}  // namespace mrroc::haptic
