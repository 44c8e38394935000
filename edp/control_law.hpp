// Parallel position/force control law, one step of a macrostep.
// Zielinski & Winiarski, "Motion Generation in the MRROC++ Robot Programming Framework" (MG), sec. 8.1, eq.
// (28).
#pragma once
#include <array>
#include <cstddef>

#include "base/axis_command.hpp"
#include "base/spatial.hpp"

namespace mrroc::edp {

/// @return the row with the entries that its behaviour does not have set to zero (MG 8.1.2): UNGUARDED keeps
///         the velocity only (B = 0: force has no effect), GUARDED has no F_d, CONTACT no r'_d
constexpr AxisCommand behaving(const AxisCommand& row) noexcept {
  switch (row.b) {
    case Behaviour::unguarded:
      return u(row.velocity);
    case Behaviour::guarded:
      return g(row.velocity, row.inertia, row.mobility);
    case Behaviour::contact:
      break;
  }
  return c(row.force, row.inertia, row.mobility);
}

/// Velocity to command along or about one axis in the next step, eq. (28):
///
///     v_c(iota+1) = ((B (F_d - F_a(iota)) + v_d) dt + B I v_c(iota)) / (dt + B I)
///
/// @param row     command of the axis; entries that its behaviour does not have are ignored
/// @param F_a     adjusted force that the effector exerts along the axis [N], [N m]
/// @param v_prev  velocity computed in the step before, expressed in the present frame E [m/s], [rad/s]
/// @param dt      duration of a step [s], above zero
/// @return [m/s], [rad/s]. Real-time safe
constexpr double axis_velocity(const AxisCommand& row, double F_a, double v_prev, double dt) noexcept {
  const AxisCommand a = behaving(row);
  const double BI = a.mobility * a.inertia;
  return ((a.mobility * (a.force - F_a) + a.velocity) * dt + BI * v_prev) / (dt + BI);
}

/// Of each axis of E, 0 < share <= 1: how much of the commanded mobility it has (edp/softening.hpp).
using MobilityShares = std::array<double, 6>;

/// @return the rows with mobility s B, inertia I / s and velocity s v_d on axes on which force acts: (28) then gives s times
///         the velocity of the rows as commanded, and the force still settles at F_d or v_d / B. Real-time safe
constexpr TaskFrameCommand softened(TaskFrameCommand rows, const MobilityShares& shares) noexcept {
  for (const Axis a : kAxes) {
    AxisCommand& row = rows[a];
    const double s = shares[static_cast<std::size_t>(a)];
    if (row.b == Behaviour::unguarded || s == 1) continue;
    row.velocity *= s;
    row.mobility *= s;
    row.inertia /= s;
  }
  return rows;
}

/// Eq. (28) for all six axes of E. No state: the caller keeps v_prev. Real-time safe.
constexpr Twist step_velocity(const TaskFrameCommand& command, const Wrench& F_a, const Twist& v_prev,
                              double dt) noexcept {
  Twist v;
  for (const Axis a : kAxes) v[a] = axis_velocity(command[a], F_a[a], v_prev[a], dt);
  return v;
}

/// Force at which an axis comes to rest against a fixed obstacle: v/B when guarded, F_d in contact.
/// @param row a guarded row with B > 0, or a contact row; an unguarded axis does not come to rest
/// @return [N], [N m]
constexpr double settled_force(const AxisCommand& row) noexcept {
  return row.b == Behaviour::contact ? row.force : row.velocity / row.mobility;
}

/// Force of an axis that moves under (28) from rest into a spring, after a number of steps, with an ideal
/// plant: one that is where it is commanded to be one step later.
/// @param stiffness of the obstacle, touched from the beginning [N/m], [N m/rad]
/// @return [N], [N m]
constexpr double settle(const AxisCommand& row, double stiffness, double dt = 0.002,
                        int steps = 2000) noexcept {
  double x = 0;
  double v = 0;
  for (int k = 0; k < steps; ++k) {
    v = axis_velocity(row, stiffness * x, v, dt);
    x += v * dt;
  }
  return stiffness * x;
}

}  // namespace mrroc::edp
