// One row per axis of the task frame, as in the papers' command tables (MG tabs 4-8, MS tabs 1-4).
#pragma once
#include "base/spatial.hpp"

namespace mrroc {

/// Behaviour b of the effector along or about one axis (MG 8.1.2).
/// unguarded: forces have no effect; guarded: a velocity with compliance; contact: a force alone.
enum class Behaviour : std::uint8_t { unguarded, guarded, contact };

/// One row of a command table. Build it with u(), g() or c(): the entries that the papers mark "-" cannot be
/// given. Linear axes are in N, m/s, kg, s/kg; rotational ones in N m, rad/s, kg m^2, s/(kg m^2).
struct AxisCommand {
  Behaviour b{Behaviour::unguarded};  ///< b, which of the other entries count
  double force{};                     ///< F_d, desired force that the effector exerts
  double velocity{};                  ///< r'_d, desired velocity
  double inertia{};                   ///< I, virtual inertia, not negative
  double mobility{};                  ///< B, reciprocal of damping, not negative

  friend constexpr bool operator==(const AxisCommand&, const AxisCommand&) = default;
};

/// UNGUARDED motion: velocity only, force has no effect.
constexpr AxisCommand u(double velocity = 0) { return {Behaviour::unguarded, 0, velocity, 0, 0}; }
/// GUARDED motion: velocity with compliance; in contact the force settles at velocity / B.
constexpr AxisCommand g(double velocity, double I, double B) {
  return {Behaviour::guarded, 0, velocity, I, B};
}
/// CONTACT: force only; in free motion the velocity settles at B * force.
constexpr AxisCommand c(double force, double I, double B) { return {Behaviour::contact, force, 0, I, B}; }

/// Rows for all axes of the task frame E.
struct TaskFrameCommand {
  AxisCommand x{}, y{}, z{}, ax{}, ay{}, az{};  ///< a row that is not given: UNGUARDED, at rest

  constexpr const AxisCommand& operator[](Axis a) const {
    switch (a) {
      case Axis::x:
        return x;
      case Axis::y:
        return y;
      case Axis::z:
        return z;
      case Axis::ax:
        return ax;
      case Axis::ay:
        return ay;
      case Axis::az:
        break;
    }
    return az;
  }
  constexpr AxisCommand& operator[](Axis a) {
    return const_cast<AxisCommand&>(static_cast<const TaskFrameCommand&>(*this)[a]);
  }
  friend constexpr bool operator==(const TaskFrameCommand&, const TaskFrameCommand&) = default;
};

}  // namespace mrroc
