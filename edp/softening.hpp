// What a driver does about a contact that begins to swing, before it is a fault: the axis gives way more slowly.
#pragma once
#include "edp/control_law.hpp"
#include "edp/oscillation.hpp"

namespace mrroc::edp {

/// Lowers the mobility B of an axis by half whenever its contact swings, down to a share of it.
///
/// With the share s an axis has s B, I / s and s v_d in law (28): its velocity is s times that of the law as commanded, so a contact
/// of stiffness K is as stable as one of s K is with that law. The force at which it settles, F_d or v_d / B, stays. A contact
/// that is stiffer than the behaviour was made for, or gears that give way, need a share that nobody knows before; here it is
/// found by what it cures, at swings half as large as those that are a fault, after two periods of them. An axis has its whole
/// mobility back when force does not act on it any more, and by and by while nothing touches it. Real-time safe.
class Softening {
 public:
  /// @param p  what the driver calls an unstable contact, and the least share @param dt  duration of a step [s]
  Softening(const OscillationParameters& p, double dt) noexcept;

  /// One step. @param F_a  adjusted force in E @param watched  axes on which force acts
  /// @return the axes that have been softened in this step
  AxisSet step(const Wrench& F_a, AxisSet watched) noexcept;

  /// @return what each axis has of its mobility, softest..1
  [[nodiscard]] const MobilityShares& shares() const noexcept { return shares_; }

 private:
  OscillationParameters early_;  // what is looked for
  OscillationObserver observer_;
  double softest_;
  double recovery_;  // factor of a share in a step without contact
  MobilityShares shares_;
};

}  // namespace mrroc::edp
